"""Configuration of the site. docs/site/build makes its sources, in build/docs/source, and runs Sphinx."""

import pathlib
import string
import sys

from sphinx.search.en import SearchEnglish

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "docs/site"), str(ROOT / "build/python")]

project = "maxwrench"
html_title = "maxwrench"
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "docstrings", "formulas", "glossary_links", "headers"]
language = "en"

highlight_language = "none"
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath"]

breathe_projects = {"maxwrench": str(ROOT / "build/docs/xml")}
breathe_default_project = "maxwrench"
breathe_default_members = ("members",)
breathe_show_include = False
breathe_order_parameters_first = True
cpp_paren_attributes = ["alignas"]

autodoc_member_order = "bysource"

# Words whose everyday meaning is more frequent than that of the glossary.
glossary_without = ["case", "contact", "held", "path", "row", "task", "value", "wall time"]

html_math_renderer = "katex"
html_theme = "furo"
html_static_path = [str(ROOT / "docs/site/static")]
html_css_files = ["site.css"]
# A letter, as in Ctrl-C, finds what has nothing to do with it.
SearchEnglish.stopwords.update(string.ascii_lowercase)
html_search_scorer = str(ROOT / "docs/site/static/scorer.js")
# The report, the paper and the pages of view are linked as files.
html_extra_path = [str(ROOT / "build/docs/extra")]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
pygments_style = "tango"
pygments_dark_style = "github-dark"
