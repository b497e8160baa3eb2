#include "view/page_file.h"

#include "view/copied_file.h"

MAXWRENCH_COPIED_FILE(page_file, "page/page.html")
