#!/usr/bin/env bash
# Packs the WebAssembly modules of MODULE_FOLDER with the entry in web/npm, its types and the licences of what is linked in:
# FOLDER/beeline-arms-VERSION.tgz. Needs web/node_modules, which scripts/web.sh installs.
# Usage: npm.sh MODULE_FOLDER FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
modules=$1 folder=$2
max_bytes=4000000
if [[ ${BEELINE_WEB_QUICK:-} == ON ]]; then max_bytes=7500000; fi  # modules that .ci/run builds

PATH=$(scripts/node_path.sh)
if [[ ! -f $modules/core.wasm || ! -d web/node_modules ]]; then
  echo "$0: no core.wasm in $modules, or no web/node_modules: make web" >&2
  exit 1
fi
work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT

(cd web && npx tsc --project npm --outDir "$work")
mkdir "$work/wasm" "$work/licences"
cp "$modules"/{core,beeline}.{js,wasm} "$work/wasm"
chmod 644 "$work/wasm"/*
cp LICENSE "$work"
cp docs/howto/javascript.md "$work/README.md"
cp /usr/share/common-licenses/Apache-2.0 "$work/licences"  # which the others name
for package in emscripten libcli11-dev libeigen3-dev libfast-float-dev libfmt-dev libhwy-dev libtinyxml2-dev \
  libyaml-cpp-dev nlohmann-json3-dev; do
  cp "/usr/share/doc/$package/copyright" "$work/licences/$package"
done
version=$(sed -n 's/^project(beeline VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
cp web/npm/package.json "$work"
(cd "$work" && npm pkg set version="$version")

rm -rf "$folder"
mkdir -p "$folder"
npm pack --silent "$work" --pack-destination "$folder" >/dev/null
package=$(echo "$folder"/*.tgz)
bytes=$(stat --format=%s "$package")
echo "The npm package: $package, $bytes bytes"
if ((bytes > max_bytes)); then
  echo "$0: more than $max_bytes bytes" >&2
  exit 1
fi
