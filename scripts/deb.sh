#!/usr/bin/env bash
# Builds the Debian packages from a clean export of HEAD, checks them with lintian, and writes them with their SHA-256 sums
# into FOLDER/SUITE: beeline (the command, with the page where `make web` has built it) and libbeeline-dev. For this system
# it builds here; for another suite in a bare system (scripts/bare_debian.sh).
# Usage: deb.sh FOLDER [SUITE...]; default: this system's suite
set -euo pipefail
cd "$(dirname "$0")/.."
out=$1
shift
# shellcheck disable=SC1091
here=$(. /etc/os-release && echo "${VERSION_CODENAME:-unstable}")
(($#)) || set -- "$here"
jobs=${JOBS:-$(nproc)}

# export_sources FOLDER: what git has, and the page with the notices of the libraries in it.
export_sources() {
  rm -rf --one-file-system "$1"
  mkdir -p "$1"
  git archive HEAD | tar --extract --directory "$1"
  if [[ ! -f build/web/saved.html ]]; then
    echo "$0: the packages lack the page: make web" >&2
    return
  fi
  mkdir -p "$1/build"
  cp -r build/web "$1/build/web"
  packaging/page_notices.py "$1/notices"
  # Emscripten's libraries are in the page's module.
  if [[ -f /usr/share/doc/emscripten/copyright ]]; then cp /usr/share/doc/emscripten/copyright "$1/notices/emscripten"; fi
}

# The version in CMakeLists.txt; before its release, the commit makes it unique, and earlier than the release.
version=$(sed -n 's/^project(beeline VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
if grep -q "^## $version, unreleased" CHANGELOG.md; then
  version+="~$(git log -1 --format=%cd.%h --abbrev=8 --date=format:%Y%m%d)"
fi
date=$(git log -1 --format=%cD)

# The build names a home of its own: a cache for the compiler must be named here. Only with this sloppiness it takes
# files with a precompiled header.
use_ccache() {
  command -v ccache >/dev/null || return 0
  export CCACHE_DIR=${CCACHE_DIR:-$(ccache --get-config cache_dir)} CCACHE_BASEDIR=$1 CCACHE_NOHASHDIR=1
  export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros,include_file_mtime,include_file_ctime}
}

for suite in "$@"; do
  work=$PWD/build-deb/$suite
  begin=$SECONDS
  export_sources "$work/source"
  rm -f "$work"/*.deb "$work"/*.changes "$work"/*.buildinfo
  echo "Building the Debian packages of Beeline $version for $suite: $work/log"
  if [[ $suite == "$here" ]]; then
    (use_ccache "$work/source" && cd "$work/source" && packaging/debian_build.sh "$version" "$date" "$jobs")
  else
    SHARED=$work scripts/bare_debian.sh "$suite" bash -euo pipefail -c '
      export DEBIAN_FRONTEND=noninteractive CCACHE_DIR=/shared/ccache CCACHE_BASEDIR=/shared/source CCACHE_NOHASHDIR=1
      export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      apt-get --quiet --quiet update
      apt-get --quiet --quiet install --yes --no-install-recommends build-essential ccache lintian >/dev/null
      cd /shared/source
      apt-get --quiet --quiet build-dep --yes --no-install-recommends ./packaging >/dev/null
      packaging/debian_build.sh "$@"' bash "$version" "$date" "$jobs"
  fi >"$work/log" 2>&1 || { tail -n 60 "$work/log" >&2; exit 1; }
  mkdir -p "$out/$suite"
  rm -f "$out/$suite"/*.deb "$out/$suite"/*.deb.sha256
  for package in "$work"/*.deb; do
    cp "$package" "$out/$suite"
    (cd "$out/$suite" && sha256sum "${package##*/}" >"${package##*/}.sha256")
    printf '%s: %d bytes\n' "$out/$suite/${package##*/}" "$(stat --format=%s "$package")"
  done
  echo "Built for $suite in $((SECONDS - begin)) s"
done
