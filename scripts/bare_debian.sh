#!/usr/bin/env bash
# Runs a command in a bare Debian, which takes nothing from this machine but its network, on a copy of this checkout: the
# files that git tracks, as they are now, in /beeline. Needs root and the package debootstrap.
# Usage: bare_debian.sh SUITE COMMAND..., such as bare_debian.sh trixie make demo
#
# build-bare/SUITE.tar keeps the bare system. Each run unpacks it into build-bare/SUITE; KEEP=1 uses what the last run left.
# SHARED=FOLDER: the command finds this folder of this machine as /shared and may write into it.
set -euo pipefail
cd "$(dirname "$0")/.."
suite=${1:-}
if [[ ! $suite =~ ^[a-z]+$ ]] || (($# < 2)); then
  echo "Usage: $0 SUITE COMMAND..., such as $0 trixie make demo" >&2
  exit 2
fi
shift
if [[ $(id -u) != 0 ]] || ! command -v debootstrap >/dev/null; then
  echo "$0: needs root and the package debootstrap" >&2
  exit 1
fi
mkdir -p build-bare
root=$PWD/build-bare/$suite

if [[ ! -f $root.tar ]]; then
  echo "Unpacking a bare Debian, $suite"
  rm -rf --one-file-system "$root"
  # The mirror of this machine, where it is a Debian; otherwise debootstrap's own.
  # shellcheck disable=SC2016  # apt-get expands it
  mirror=$(apt-get indextargets --format '$(LABEL) $(REPO_URI)' | awk '$1 == "Debian" {mirror = $2} END {print mirror}')
  debootstrap --variant=minbase --include=ca-certificates,make "$suite" "$root" ${mirror:+"$mirror"} >"$root.log"
  tar --create --file "$root.tar.new" --one-file-system --directory "$root" .
  mv "$root.tar.new" "$root.tar"
fi
if [[ ! -d $root/beeline || -z ${KEEP:-} ]]; then
  rm -rf --one-file-system "$root"
  mkdir -p "$root/beeline.new"
  tar --extract --file "$root.tar" --directory "$root"
  git ls-files -z | tar --create --null --files-from=- | tar --extract --no-same-owner --directory "$root/beeline.new"
  mv "$root/beeline.new" "$root/beeline"
fi

# The network: name servers, certificates, proxies.
cp /etc/resolv.conf "$root/etc/resolv.conf"
if [[ -d /usr/local/share/ca-certificates ]]; then cp -r /usr/local/share/ca-certificates "$root/usr/local/share/"; fi
certificates=/etc/ssl/certs/ca-certificates.crt
network=(PIP_CERT="$certificates" NODE_EXTRA_CA_CERTS="$certificates")
for name in http_proxy https_proxy no_proxy; do
  if [[ -n ${!name:-} ]]; then network+=("$name=${!name}"); fi
done

# The process alone sees what is mounted here, and the mounts end with it. The system has devices of its own, so that no
# command in it removes devices of this machine.
# shellcheck disable=SC2016  # expands inside
unshare --mount --pid --fork --kill-child bash -euo pipefail -c '
  root=$1 shared=$2
  shift 2
  if [[ -n $shared ]]; then mkdir -p "$root/shared" && mount --bind "$shared" "$root/shared"; fi
  mount -t proc proc "$root/proc"
  mount -t sysfs sysfs "$root/sys"
  mount -t tmpfs -o mode=755 tmpfs "$root/dev"
  for device in "null 1 3" "zero 1 5" "full 1 7" "random 1 8" "urandom 1 9" "tty 5 0"; do
    read -r name major minor <<<"$device"
    mknod -m 666 "$root/dev/$name" c "$major" "$minor"
  done
  ln -s /proc/self/fd "$root/dev/fd"
  for stream in 0:stdin 1:stdout 2:stderr; do ln -s "/proc/self/fd/${stream%:*}" "$root/dev/${stream#*:}"; done
  mkdir "$root/dev/shm" "$root/dev/pts"
  mount -t tmpfs tmpfs "$root/dev/shm"
  mount -t devpts -o newinstance,ptmxmode=666 devpts "$root/dev/pts"
  ln -s pts/ptmx "$root/dev/ptmx"
  chroot "$root" update-ca-certificates >/dev/null
  exec chroot "$root" /usr/bin/env --chdir=/beeline "$@"
' - "$root" "${SHARED:-}" -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 "${network[@]}" "$@"
