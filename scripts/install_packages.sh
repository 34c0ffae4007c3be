#!/usr/bin/env bash
# Installs the Debian packages of the named groups that are not there yet.
# Usage: install_packages.sh build|test|python|peers|bench|lint|docs|web|arm|fuzz|mpi|portable...
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
portable=(debootstrap util-linux)

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
    portable) wanted+=("${portable[@]}") ;;
    *) echo "$0: no group '$group': build, test, python, peers, bench, lint, docs, web, arm, fuzz, mpi, portable" >&2; exit 2 ;;
  esac
done

# CMake is asked for its version, as presets need it before any message of ours.
check_cmake() {
  local needed=3.25 version
  if ! version=$(cmake --version 2>/dev/null | sed -n 's/^cmake version //p'); then return; fi
  if [[ -n $version && $(printf '%s\n' "$needed" "$version" | sort --version-sort | head -n 1) != "$needed" ]]; then
    echo "CMake $version is too old, $needed or later is needed. One that changes nothing of the system:" \
         "python3 -m venv ~/cmake && ~/cmake/bin/pip install cmake, then PATH=~/cmake/bin:\$PATH make ..." >&2
    exit 1
  fi
}
trap check_cmake EXIT

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

# What a distribution does not have under this name is left out: CMake's message then says how to go on.
absent=()
for package in "${missing[@]}"; do
  [[ $(apt-cache policy "$package") == *"Candidate: "[^\(]* ]] || absent+=("$package")
done
for package in "${absent[@]}"; do
  case $package in
    libcairo2-dev) option=BEELINE_CAIRO ;;
    libhdf5-dev) option=BEELINE_HDF5 ;;
    libcpp-httplib-dev) option=BEELINE_VIEW ;;
    *) option= ;;
  esac
  echo "This system has no package $package: ${option:+go on without it by cmake --preset release -D$option=OFF, or }install" \
       "what it holds otherwise and set CMAKE_PREFIX_PATH" >&2
done
present=()
for package in "${missing[@]}"; do
  [[ " ${absent[*]} " == *" $package "* ]] || present+=("$package")
done
((${#present[@]})) || exit 0
"${apt[@]}" install --yes --no-install-recommends "${present[@]}"
