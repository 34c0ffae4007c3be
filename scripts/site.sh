#!/usr/bin/env bash
# Joins the page and the documentation into one folder that any static web server serves, with the page in front. No link is
# dead and nothing is loaded from elsewhere, or it fails.
# Usage: site.sh WEB HTML FOLDER, the folders of `make web` and of the documentation's pages, and the one to write
set -euo pipefail
cd "$(dirname "$0")/.."
web=$1 html=$2 folder=$3

rm -rf "$folder.new"
mkdir -p "$folder.new"
rsync --archive "$web/" "$folder.new/"
# The documentation's own copy of the page gives way to the one in front.
rsync --archive --exclude=/page.html --exclude=/.doctrees --exclude=/.buildinfo "$html/" "$folder.new/docs/"
sed -i 's|<body>|<body data-docs="docs">|' "$folder.new/index.html"
grep --quiet 'data-docs="docs"' "$folder.new/index.html"
cat >"$folder.new/docs/page.html" <<'END'
<!doctype html>
<html lang="en">
  <meta charset="utf-8">
  <title>Beeline: the page</title>
  <meta http-equiv="refresh" content="0; url=../index.html#arm=panda">
  <a href="../index.html">The page</a>
</html>
END
python3 -B docs/sphinx/links.py "$folder.new" >/dev/null
rm -rf "$folder"
mv "$folder.new" "$folder"
echo "The site: $folder/index.html, $(find "$folder" -type f | wc -l) files, $(du --summarize --human-readable "$folder" | cut -f 1)"
