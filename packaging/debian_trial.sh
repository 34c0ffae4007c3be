#!/usr/bin/env bash
# Installs the Debian packages of FOLDER with apt, tries what a user does first, removes them, and looks for what stays
# behind. Only for a system that may be thrown away: scripts/try_deb.sh runs it in a bare one.
# Usage: debian_trial.sh FOLDER
set -euo pipefail
folder=$(realpath "$1")
export DEBIAN_FRONTEND=noninteractive
cd "$(mktemp --directory)"

fail() {
  echo "FAILS: $*" >&2
  exit 1
}

# expect TEXT COMMAND...: the command succeeds and prints the text.
expect() {
  local text=$1 answer
  shift
  answer=$("$@" 2>&1) || fail "$*: exit code $?: $answer"
  [[ $answer == *"$text"* ]] || fail "$*: prints no '$text': $answer"
  echo "works: ${*%%$'\n'*}"
}

install() { apt-get --quiet --quiet install --yes --no-install-recommends "$@" >/dev/null; }

try_command() {
  local version
  version=$(dpkg-query --show --showformat='${source:Upstream-Version}' beeline)
  expect "${version%%[~-]*}" beeline --version
  expect "x -0.81725" beeline fk ur5 --q 0,0,0,0,0,0
  expect "solution" beeline ik ur5 --pose 0.4,0.2,0.3,3.14,0,0 --all
  local end
  for end in svg png pdf; do
    beeline draw ur5 --out "ur5.$end" >/dev/null || fail "beeline draw, $end"
    [[ -s ur5.$end ]] || fail "ur5.$end is empty"
  done
}

try_page() {
  if [[ ! -d /usr/share/beeline/web ]]; then
    echo "The package has no page: it was built without one"
    return
  fi
  expect "" beeline view ur5 --save ur5.html
  grep -q '</html>' ur5.html || fail "ur5.html is not a whole page"
  beeline view ur5 --no-browser >address 2>&1 &
  local server=$! port
  until port=$(grep -o ':[0-9]\+/' address | tr -d ':/'); do kill -0 "$server" || fail "beeline view ends"; done
  exec 3<>"/dev/tcp/127.0.0.1/$port"
  printf 'GET / HTTP/1.1\r\nHost: 127.0.0.1:%s\r\nConnection: close\r\n\r\n' "$port" >&3
  expect "</html>" cat <&3
  exec 3>&-
  kill "$server"
  wait "$server" || fail "beeline view: exit code $?"
}

try_manual() {
  MANPAGER=cat MANWIDTH=80 expect "plan and prove motions" man beeline
}

try_completions() {
  # shellcheck disable=SC2016  # expands inside
  expect "retime" bash -c '# the completion of bash
    . /usr/share/bash-completion/bash_completion
    _completion_loader beeline || true
    COMP_WORDS=(beeline ret) COMP_CWORD=1 COMP_LINE="beeline ret" COMP_POINT=11
    _beeline && printf "%s\n" "${COMPREPLY[@]}"'
  # shellcheck disable=SC2016
  expect "_beeline" zsh -c 'autoload -Uz compinit && compinit -D && print $_comps[beeline]'
  expect "retime" fish -c 'complete --do-complete "beeline ret"'
}

# try_library PROGRAM: a CMake project of five lines takes everything.
try_library() {
  local program
  program=$(basename "$1" .cpp)
  mkdir "$program"
  cp "$1" "$program/main.cpp"
  cat >"$program/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(own LANGUAGES CXX)
find_package(beeline REQUIRED)
add_executable(own main.cpp)
target_link_libraries(own PRIVATE beeline::beeline)
END
  cmake -S "$program" -B "$program/build" >/dev/null || fail "cmake does not find beeline"
  cmake --build "$program/build" >/dev/null || fail "$program does not compile"
  expect "solved" "$program/build/own"
}

# Whatever has the name of the package, or is a file of it. Not looked at: apt's archives, logs, and the pages that man has
# formatted, which it removes itself in time.
find_remains() {
  local path
  while read -r path; do
    # Folders of others stay.
    if [[ -e $path && (! -d $path || $path == *beeline*) ]]; then echo "$path"; fi
  done <owned
  find / -xdev -path /beeline -prune -o -path "$folder" -prune -o -path /tmp -prune -o -path /var/log -prune \
    -o -path /var/cache/apt -prune -o -path /var/cache/man -prune -o -iname '*beeline*' -print
  dpkg-query --show 'beeline*' 'libbeeline*' 2>/dev/null || true
}

apt-get --quiet --quiet update
install "$folder"/beeline_*.deb
try_command
try_page
install man-db bash-completion zsh fish
try_manual
try_completions
install "$folder"/libbeeline-dev_*.deb cmake g++
try_library /usr/share/doc/beeline/examples/00_ten_lines.cpp

dpkg --listfiles beeline libbeeline-dev | sort -u >owned
dpkg --verify beeline libbeeline-dev | grep . && fail "installed files differ"
apt-get --quiet --quiet purge --yes beeline libbeeline-dev >/dev/null
remains=$(find_remains)
[[ -z $remains ]] || fail "stays behind: $remains"
echo "works: nothing stays behind of $(wc -l <owned) files and folders"
