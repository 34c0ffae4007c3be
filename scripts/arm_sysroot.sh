#!/usr/bin/env bash
# Unpacks into FOLDER the libraries of Debian for 64-bit ARM, with all that they depend on: what the compiler
# g++-aarch64-linux-gnu links with and qemu-aarch64 loads. apt's own records for it lie in a temporary folder: nothing
# of the machine changes, whose packages could not stand beside these (libyaml-cpp-dev). Does nothing where they are.
# Usage: arm_sysroot.sh FOLDER
set -euo pipefail
packages=(libc6 libstdc++6 libgtest-dev
          libeigen3-dev libhwy-dev libtbb-dev libtinyxml2-dev libyaml-cpp-dev nlohmann-json3-dev
          libcli11-dev libfmt-dev libfast-float-dev)
folder=$1
if [[ $(cat "$folder/packages" 2>/dev/null) == "${packages[*]}" ]]; then exit 0; fi
rm -rf "$folder"
mkdir -p "$folder"

work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
mkdir -p "$work"/{state/lists/partial,cache/archives/partial}
touch "$work/status"
apt=(apt-get -qq -o APT::Sandbox::User=root -o APT::Architecture=arm64 -o APT::Architectures=arm64
     -o "Dir::State=$work/state" -o "Dir::State::status=$work/status" -o "Dir::Cache=$work/cache"
     -o Debug::NoLocking=1)
echo "Unpacking Debian's libraries for ARM"
"${apt[@]}" update
"${apt[@]}" install --yes --no-install-recommends --download-only "${packages[@]}"
for package in "$work"/cache/archives/*.deb; do
  dpkg-deb --extract "$package" "$folder"
done
# The compiler's own headers and libraries, which it looks for below the sysroot.
ln -s /usr/aarch64-linux-gnu "$folder/usr/aarch64-linux-gnu"
echo "${packages[*]}" >"$folder/packages"
