#!/usr/bin/env bash
# Installs the Debian packages of the named groups that are not there yet.
# Usage: install_packages.sh build|test|python|peers|bench|clang|lint|docs|web|arm|mpi|portable|deb...
set -euo pipefail

build=(g++ cmake ninja-build ccache pkg-config
       libeigen3-dev libhwy-dev libtbb-dev libtinyxml2-dev libyaml-cpp-dev nlohmann-json3-dev
       libcli11-dev libfmt-dev libfast-float-dev libcairo2-dev libcpp-httplib-dev zlib1g-dev libhdf5-dev
       libassimp-dev)
test=(libgtest-dev python3 python3-pytest python3-numpy python3-jsonschema)
peers=(ffmpeg)
python=(python3 python3-dev python3-venv)
bench=(libbenchmark-dev liborocos-kdl-dev python3 python3-venv valgrind)
docs=(doxygen rsync)
mpi=(libopenmpi-dev openmpi-bin iproute2 procps)
clang=(clang libclang-rt-dev llvm)  # sanitizers, with the program that names the lines of their findings
web=(emscripten dpkg-dev chromium-headless-shell python3 python3-venv)
arm=(g++-aarch64-linux-gnu qemu-user)
lint=(shellcheck python3 python3-venv)
portable=(debootstrap util-linux)
deb=(debhelper dpkg-dev lintian python3)

wanted=()
for group in "$@"; do
  case $group in
    build) wanted+=("${build[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    peers) wanted+=("${peers[@]}") ;;
    clang) wanted+=("${clang[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    python) wanted+=("${python[@]}") ;;
    lint) wanted+=("${lint[@]}") ;;
    web) wanted+=("${web[@]}") ;;
    arm) wanted+=("${arm[@]}") ;;
    docs) wanted+=("${docs[@]}") ;;
    mpi) wanted+=("${mpi[@]}") ;;
    portable) wanted+=("${portable[@]}") ;;
    deb) wanted+=("${deb[@]}") ;;
    *) echo "$0: no group '$group': build, test, python, peers, bench, clang, lint, docs, web, arm, mpi, portable, deb" >&2; exit 2 ;;
  esac
done

# Refuses a CMake that is too old with the way to a newer one: it would fail at the presets without saying so.
check_cmake() {
  local needed version
  needed=$(sed -n 's/^cmake_minimum_required(VERSION \(.*\))/\1/p' "$(dirname "$0")/../CMakeLists.txt")
  version=$(cmake --version 2>/dev/null | sed -n 's/^cmake version //p')
  if [[ -n $version && $(printf '%s\n' "$needed" "$version" | sort --version-sort | head -n 1) != "$needed" ]]; then
    echo "CMake $version is too old: $needed or later is needed. To use a newer one without changing the system:" \
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

# Packages that this system does not have under these names: CMake says what is missing of what is really needed.
absent=()
find_absent() {
  absent=()
  local package
  for package in "${missing[@]}"; do
    [[ $(LC_ALL=C apt-cache policy "$package") == *"Candidate: "[^\(]* ]] || absent+=("$package")
  done
}

root=()
if [[ $(id -u) != 0 ]]; then root=(sudo); fi
# One at a time: apt waits for others that install, not for others that read the lists.
exec 9>"${TMPDIR:-/tmp}/beeline-packages-$(id -u).lock"
flock 9
apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --quiet --quiet -o DPkg::Lock::Timeout=600)
find_absent
# With the lists of today, packages that they lack are not looked for again.
if ((${#absent[@]} < ${#missing[@]})) || ! find /var/lib/apt/lists -maxdepth 1 -mtime -1 -name '*Packages*' | grep -q .; then
  echo "Installing ${missing[*]}"
  "${apt[@]}" update
  find_absent
fi

present=()
for package in "${missing[@]}"; do
  case " ${absent[*]} " in
    *" $package "*) ;;
    *) present+=("$package") && continue ;;
  esac
  advice="install what it holds in another way"
  case $package in
    libcairo2-dev) advice="build without it (cmake --preset release -DBEELINE_CAIRO=OFF), or $advice" ;;
    libhdf5-dev) advice="build without it (cmake --preset release -DBEELINE_HDF5=OFF), or $advice" ;;
    libassimp-dev) advice="the build does without it, and reads meshes as STL and OBJ alone, or $advice" ;;
    libcpp-httplib-dev) advice="build without it (cmake --preset release -DBEELINE_VIEW=OFF), or $advice" ;;
    lib*) advice+=" and name its folder in CMAKE_PREFIX_PATH" ;;
  esac
  echo "This system has no package $package: $advice" >&2
done
if ((${#present[@]})); then "${apt[@]}" install --yes --no-install-recommends "${present[@]}"; fi
