#!/usr/bin/env bash
# Installs the Debian packages of the named groups that are not there yet.
# Usage: install_packages.sh build|test|python|peers|bench|lint|docs|web|arm|fuzz|mpi...
set -euo pipefail

build=(g++ cmake ninja-build ccache pkg-config
       libeigen3-dev libhwy-dev libtbb-dev libtinyxml2-dev libyaml-cpp-dev nlohmann-json3-dev
       libcli11-dev libfmt-dev libfast-float-dev libcairo2-dev libcpp-httplib-dev libhdf5-dev zlib1g-dev)
test=(libgtest-dev python3 python3-pytest python3-numpy python3-jsonschema)
peers=(ffmpeg)
python=(python3 python3-dev python3-venv)
bench=(libbenchmark-dev liborocos-kdl-dev python3 python3-venv valgrind)
docs=(doxygen rsync)
mpi=(libopenmpi-dev openmpi-bin iproute2 procps)
fuzz=(clang-14 libclang-rt-14-dev)
web=(emscripten dpkg-dev chromium python3 python3-venv)
arm=(g++-aarch64-linux-gnu qemu-user)
lint=(shellcheck python3 python3-venv)

wanted=()
for group in "$@"; do
  case $group in
    build) wanted+=("${build[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    peers) wanted+=("${peers[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    python) wanted+=("${python[@]}") ;;
    lint) wanted+=("${lint[@]}") ;;
    web) wanted+=("${web[@]}") ;;
    arm) wanted+=("${arm[@]}") ;;
    docs) wanted+=("${docs[@]}") ;;
    mpi) wanted+=("${mpi[@]}") ;;
    fuzz) wanted+=("${fuzz[@]}") ;;
    *) echo "$0: no group '$group': build, test, python, peers, bench, lint, docs, web, arm, fuzz, mpi" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query >/dev/null; then
  echo "This is not Debian: what is needed must be there already, under your system's names for" \
       "${wanted[*]}" >&2
  exit 0
fi

installed=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "${wanted[@]}" \
              2>/dev/null || true)
missing=()
for package in "${wanted[@]}"; do
  grep -qx "installed $package" <<<"$installed" || missing+=("$package")
done
((${#missing[@]})) || exit 0

root=()
if [[ $(id -u) != 0 ]]; then root=(sudo); fi
echo "Installing ${missing[*]}"
apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --quiet --quiet)
"${apt[@]}" update
"${apt[@]}" install --yes --no-install-recommends "${missing[@]}"
