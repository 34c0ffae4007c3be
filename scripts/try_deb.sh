#!/usr/bin/env bash
# Tries the Debian packages that scripts/deb.sh has written into FOLDER/SUITE, each in a bare system of its suite: installs
# them with apt, tries the command, the page, the manual page, the completions and the library, and removes them. Needs root.
# Usage: try_deb.sh FOLDER [SUITE...]; default: every suite in the folder
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$1
shift
if (($# == 0)); then
  for suite in "$folder"/*/; do set -- "$@" "$(basename "$suite")"; done
fi
for suite in "$@"; do
  if ! compgen -G "$folder/$suite/beeline_*.deb" >/dev/null; then
    echo "$0: no package in $folder/$suite: scripts/deb.sh $folder $suite" >&2
    exit 1
  fi
  begin=$SECONDS
  echo "Trying the packages of $folder/$suite in a bare system"
  SHARED=$PWD/$folder/$suite scripts/bare_debian.sh "$suite" packaging/debian_trial.sh /shared
  echo "Tried in $suite in $((SECONDS - begin)) s"
done
