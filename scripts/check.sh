#!/usr/bin/env bash
# What refuses most changes, found in minutes: formatting and the project's rules, the warnings of GCC and of the page's
# compiler, and the tests of the folders that changed since BASE. Everything runs before it says no.
# Usage: check.sh [BASE], a commit; default: where HEAD left its upstream branch, or HEAD without one
set -uo pipefail
cd "$(dirname "$0")/.." || exit
base=${1:-$(git merge-base HEAD '@{upstream}' 2>/dev/null || echo HEAD)}
PATH=$PWD/.venv-lint/bin:$PATH
failed=()

check() {  # NAME COMMAND...
  local name=$1 begin=$SECONDS
  shift
  "$@" || failed+=("$name")
  echo "$name: $((SECONDS - begin)) s"
}

changed() { git diff --name-only "$base" && git ls-files --others --exclude-standard; }

# The names of the tests that a changed file asks for.
tests_of() {
  case $1 in
    beeline/*/* | tests/*/*) cut -d/ -f2 <<<"$1" ;;
    beeline/* | tests/*) echo house ;;
    cli/* | python/* | docs/* | mpi/*) cut -d/ -f1 <<<"$1" ;;
  esac
}

mapfile -t folders < <(changed | while read -r file; do tests_of "$file"; done | sort -u)
targets=(beeline _core)
for folder in "${folders[@]}"; do
  if find "tests/${folder/#house/.}" -maxdepth 1 -name '*_test.cpp' 2>/dev/null | grep -q .; then
    targets+=("${folder}_test")
  fi
done
jobs=$(nproc)

formatting() { scripts/sources.sh | xargs clang-format --dry-run -Werror; }
build() { cmake --build --preset release --parallel "$jobs" --target "${targets[@]}"; }
page() { python3 -B scripts/page_warnings.py build-web-core; }
types() { (PATH=$(scripts/node_path.sh) && cd web && npm run check --silent); }
tests() {
  local names
  names=$(printf '|%s' "${folders[@]}")
  ctest --preset release --parallel "$jobs" --label-exclude peers --tests-regex "^(${names:1})(\\.(python|hostile))?\$"
}

check "formatting" formatting
check "scripts" shellcheck scripts/*.sh .ci/run
check "layers" python3 -B tests/layers.py
check "lengths" python3 -B scripts/lengths.py
check "words" python3 -B scripts/words.py
check "warnings of GCC" build
check "warnings of the page's compiler" page
if changed | grep -q '^web/' && [[ -d web/node_modules ]]; then check "types of the page" types; fi
if ((${#folders[@]})); then check "tests of ${folders[*]}" tests; fi

if ((${#failed[@]})); then
  printf 'check failed: %s\n' "${failed[*]}" >&2
  exit 1
fi
echo "Nothing found in ${SECONDS} s. Not looked at: clang-tidy and public headers alone (make lint), other folders' tests (make test)"
