# Settings of Sphinx; docs/guide.py calls it.
from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

for language in ("csv", "obj", "output"):
    lexers[language] = TextLexer()

project = "Presa"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
nitpicky = True

html_theme = "furo"
html_title = "Presa"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_static_path = ["_static"]
# Debian's KaTeX draws the formulas, without a network; the last script stands where Sphinx puts MathJax
html_css_files = ["katex/katex.min.css"]
html_js_files = ["katex/katex.min.js", "katex/contrib/auto-render.min.js"]
mathjax_path = "formulas.js"
