def completed(page, text):
    return text
