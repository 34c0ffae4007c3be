#!/usr/bin/env bash
# Runs `make` for each word, all of them even when one fails, and lists the packages that they have left in build-*/dist:
# bytes, SHA-256, file.
# Usage: packages.sh WORD...
set -uo pipefail
cd "$(dirname "$0")/.." || exit
. scripts/steps.sh

for word in "$@"; do step "make $word" make --no-print-directory "$word"; done
echo "Packages:"
find build-*/dist -type f ! -name '*.sha256' ! -path '*/unrepaired/*' | sort | while read -r file; do
  printf '%10d  %s\n' "$(stat --format=%s "$file")" "$(sha256sum "$file")"
done
refuse_failed "make packages"
