#!/usr/bin/env bash
# Unpacks into FOLDER the sources that are compiled into the WebAssembly module, as Debian has them. Reads the
# machine's own list of archives and changes nothing of it. Does nothing for what is there already.
# Usage: web_sources.sh FOLDER
set -euo pipefail
mkdir -p "$1"
folder=$(realpath "$1")

missing=()
for package in highway tinyxml2 yaml-cpp; do
  [[ -d $folder/$package ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
mkdir -p "$work"/{parts,lists/partial,cache/archives/partial,download}
touch "$work/sources.list"
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  case $list in
    *.list) if [[ -f $list ]]; then sed -n 's/^deb /deb-src /p' "$list" >>"$work/sources.list"; fi ;;
    *.sources) sed 's/^Types:.*/Types: deb-src/' "$list" >"$work/parts/${list##*/}" ;;
  esac
done
apt=(apt-get -qq -o APT::Sandbox::User=root -o "Dir::Etc::SourceList=$work/sources.list"
     -o "Dir::Etc::SourceParts=$work/parts" -o "Dir::State::Lists=$work/lists" -o "Dir::Cache=$work/cache")
echo "Unpacking the sources of ${missing[*]}"
"${apt[@]}" update
cd "$work/download"
for package in "${missing[@]}"; do
  "${apt[@]}" source --download-only "$package" >/dev/null
  mkdir "$work/$package"
  tar -xf "$(find . -name "${package}_*.orig.tar.*" ! -name '*.asc')" --strip-components 1 -C "$work/$package"
  mv "$work/$package" "$folder/$package"
done
