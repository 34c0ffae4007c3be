#!/usr/bin/env bash
# Lists the C++ sources, one a line.
set -euo pipefail
cd "$(dirname "$0")/.."
find beeline bench cli examples mpi python tests web/core -name '*.h' -o -name '*.cpp' | sort
