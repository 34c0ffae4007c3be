#!/usr/bin/env bash
# Runs a command in a bare Debian, with nothing of this machine but its network, on a copy of this checkout in which
# nothing is built: the files that git tracks, as they are now. Needs root and debootstrap.
# Usage: bare_debian.sh SUITE COMMAND..., such as bare_debian.sh trixie make demo
#
# The copy is /beeline there. build-bare/SUITE.tar keeps the bare system; build-bare/SUITE is the one that runs, made anew
# each time. KEEP=1 runs in what the last command left.
set -euo pipefail
cd "$(dirname "$0")/.."
suite=$1
shift
root=$PWD/build-bare/$suite
if [[ $(id -u) != 0 ]] || ! command -v debootstrap >/dev/null; then
  echo "$0: needs root and the package debootstrap" >&2
  exit 1
fi

if [[ ! -f $root.tar ]]; then
  echo "Unpacking a bare Debian, $suite"
  rm -rf --one-file-system "$root"
  debootstrap --variant=minbase --include=ca-certificates,make "$suite" "$root" >"$root.log"
  tar --create --file "$root.tar" --one-file-system --directory "$root" .
fi
if [[ ! -d $root/beeline || -z ${KEEP:-} ]]; then
  rm -rf --one-file-system "$root"
  mkdir -p "$root"
  tar --extract --file "$root.tar" --directory "$root"
  mkdir "$root/beeline"
  git ls-files -z | xargs -0 tar --create --ignore-failed-read | tar --extract --no-same-owner --directory "$root/beeline"
fi

# The way to the package registries: name servers, certificates, proxies.
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp -r /usr/local/share/ca-certificates "$root/usr/local/share/"
certificates=/etc/ssl/certs/ca-certificates.crt
network=(PIP_CERT="$certificates" NODE_EXTRA_CA_CERTS="$certificates")
for name in http_proxy https_proxy no_proxy; do
  if [[ -n ${!name:-} ]]; then network+=("$name=${!name}"); fi
done

# What is mounted here is seen by this process alone and ends with it. The devices are its own: those of this machine
# cannot be removed from inside.
# shellcheck disable=SC2016  # expands inside
unshare --mount --pid --fork bash -euo pipefail -c '
  root=$1
  shift
  mount -t proc proc "$root/proc"
  mount -t sysfs sysfs "$root/sys"
  mount -t tmpfs -o mode=755 tmpfs "$root/dev"
  for device in "null 1 3" "zero 1 5" "full 1 7" "random 1 8" "urandom 1 9" "tty 5 0"; do
    read -r name major minor <<<"$device"
    mknod -m 666 "$root/dev/$name" c "$major" "$minor"
  done
  ln -s /proc/self/fd "$root/dev/fd"
  for number in 0 1 2; do
    names=(stdin stdout stderr)
    ln -s "/proc/self/fd/$number" "$root/dev/${names[number]}"
  done
  mkdir "$root/dev/shm" "$root/dev/pts"
  mount -t tmpfs tmpfs "$root/dev/shm"
  mount -t devpts -o newinstance,ptmxmode=666 devpts "$root/dev/pts"
  ln -s pts/ptmx "$root/dev/ptmx"
  chroot "$root" update-ca-certificates >/dev/null 2>&1
  exec chroot "$root" /usr/bin/env --chdir=/beeline "$@"
' - "$root" -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 "${network[@]}" "$@"
