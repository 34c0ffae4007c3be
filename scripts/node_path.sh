#!/usr/bin/env bash
# Prints a PATH with Node.js that Vite runs on, and npm: the system's Node.js, or, where it is missing or too old (as on
# Debian 12), the one of web/requirements.txt, which it installs into .venv-node.
# Usage: PATH=$(scripts/node_path.sh)
set -euo pipefail
cd "$(dirname "$0")/.."

# Vite needs 20.19 or later, or 22.12 or later.
new_enough='const [a, b] = process.versions.node.split(".").map(Number);
process.exit((a === 20 && b >= 19) || (a === 22 && b >= 12) || a > 22 ? 0 : 1)'
if node -e "$new_enough" 2>/dev/null && command -v npm >/dev/null; then
  echo "$PATH"
  exit 0
fi
scripts/venv.sh .venv-node web/requirements.txt >&2
path=$PWD/.venv-node/bin:$PATH
if ! PATH=$path node -e "$new_enough" || ! PATH=$path npm --version >/dev/null; then
  echo "$0: Node.js 20.19, 22.12 or later with npm is needed; .venv-node has none that runs here" >&2
  exit 1
fi
echo "$path"
