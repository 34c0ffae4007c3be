#!/usr/bin/env bash
# Tries the npm package of FOLDER, which scripts/npm.sh has written: installs it into a new project with Vite from npm, and
# compares what it computes in Node.js, by import and from CommonJS, and on a page in a browser with the command's answers.
# Usage: BEELINE=COMMAND try_npm.sh FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
package=$(realpath "$1"/beeline-arms-*.tgz)
command=$(realpath "${BEELINE:-build/beeline}")
PATH=$(scripts/node_path.sh)
cd web
BEELINE=$command NPM_TRIAL=$package npx vitest run tests/npm.test.ts
