#!/usr/bin/env bash
# Builds and checks the Debian packages in the sources that scripts/deb.sh has exported; it runs there, on this machine or
# in a bare system. The packages lie beside the sources.
# Usage: debian_build.sh VERSION DATE JOBS, the date as RFC 5322 has it
set -euo pipefail
version=$1 date=$2 jobs=$3
# shellcheck disable=SC1091
. /etc/os-release
# Earlier than Debian's own package of the version, and than the next Debian's.
revision="1~$ID${VERSION_ID:-}"

cp -r packaging/debian debian
cat >debian/changelog <<END
beeline ($version-$revision) ${VERSION_CODENAME:-unstable}; urgency=medium

  * Built from Beeline's sources; changelog.gz has the changes of Beeline.

 -- $(sed -n 's/^Maintainer: //p' debian/control)  $date
END
sed -i "s/@COPYRIGHT@/$(sed -n 's/^Copyright (c) //p' LICENSE)/" debian/copyright
sed -n '/^Redistribution/,$p' LICENSE | sed 's/^$/./; s/^/ /' >>debian/copyright

dpkg-buildpackage --build=binary --no-sign --jobs="$jobs"
lintian --fail-on error,warning ../*.changes
