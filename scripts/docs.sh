#!/usr/bin/env bash
# Builds the documentation as one site in build/site: guides and tutorials (MkDocs), the C++ reference (Doxygen), and the Python
# reference (Sphinx) if the package is built (cmake --build build/release --target nef_python). Links are checked.
# From a bare Debian 12: bash scripts/docs.sh [FOLDER]; then python3 -m http.server -d build/site, and open http://localhost:8000.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/setup.sh
site=${1:-build/site}
mkdir -p "$site"
site=$(realpath "$site")
export NEF_SITE_PAGES=$site-pages
install_missing "${nef_docs_packages[@]}"
references='

## References

- [C++](cpp/index.html)
'
package=$(ls -d build/*/python 2>/dev/null | head -1 || true)
if compgen -G "build/*/python/nef/_nef*.so" >/dev/null; then
  references+='- [Python](python/index.html)
'
else
  echo "docs: no Python reference, since the package is not built"
  package=
fi
python3 -B scripts/docs.py "$NEF_SITE_PAGES" "$references"
# The references are put into their places below, so links to them are not checked here.
PYTHONWARNINGS=ignore mkdocs build --quiet --clean --site-dir "$site"
mkdir -p "$site/cpp"
NEF_REFERENCE=$site/cpp doxygen docs/reference/Doxyfile
rm -rf "$site/cpp/xml"
if [ -n "$package" ]; then
  # Debian's Sphinx belongs to Debian's Python, whichever comes first on the PATH.
  PYTHONPATH=$package /usr/bin/python3 -m sphinx -q -b html python/reference "$site/python"
fi
python3 -B scripts/checks/check_site.py "$site"
echo "docs: $site/index.html"
