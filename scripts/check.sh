#!/usr/bin/env bash
# Finds in minutes what most often refuses a change: formatting and the project's rules, warnings of GCC and of the page's
# compiler, and failures in the tests of the folders that changed since BASE. Everything runs before it says no.
# Usage: check.sh [BASE], a commit; default: where HEAD left its upstream branch, or HEAD without one
set -uo pipefail
cd "$(dirname "$0")/.." || exit
base=${1:-$(git merge-base HEAD '@{upstream}' 2>/dev/null || echo HEAD)}
if ! git rev-parse --verify --quiet "$base^{commit}" >/dev/null; then
  echo "$0: '$base' is no commit" >&2
  exit 2
fi
mapfile -t changed < <(git diff --name-only "$base" && git ls-files --others --exclude-standard)
jobs=$(nproc)
. scripts/steps.sh

# Prints the name of the tests that a changed file asks for; `else` where no folder of tests is its own.
tests_of() {  # in a pattern, * stands for folders too
  local folder
  case $1 in
    beeline/internal/* | tests/install/*) echo house ;;
    beeline/*/* | tests/*/*)
      folder=$(cut -d/ -f2 <<<"$1")
      if [[ -d tests/$folder ]]; then echo "$folder"; else echo else; fi
      ;;
    beeline/reason.*) echo reason ;;
    beeline/* | tests/*_test.*) echo house ;;
    cli/* | python/* | docs/*) cut -d/ -f1 <<<"$1" ;;
    web/* | *.md) ;;
    *) echo else ;;
  esac
}

mapfile -t folders < <(for file in "${changed[@]}"; do tests_of "$file"; done | grep -vx else | sort -u)
targets=(beeline stubs)
for folder in "${folders[@]}"; do
  if find "tests/${folder/#house/.}" -maxdepth 1 -name '*_test.cpp' | grep -q .; then targets+=("${folder}_test"); fi
done

build() { cmake --build --preset release --parallel "$jobs" --target "${targets[@]}"; }
page() { python3 -B scripts/page_warnings.py build-web-core; }
types() { (PATH=$(scripts/node_path.sh) && cd web && npm run check --silent); }
tests() {
  local names
  names=$(printf '|%s' "${folders[@]}")
  ctest --preset release --parallel "$jobs" --label-exclude peers --tests-regex "^(${names:1})(\\.(python|hostile))?\$"
}

step "rules" scripts/lint.sh
step "warnings of GCC" build
step "warnings of the page's compiler" page
unseen=("clang-tidy and public headers alone (make lint)")
if [[ " ${changed[*]}" == *" web/"* ]]; then
  if [[ -d web/node_modules ]]; then step "types of the page" types; fi
  unseen+=("the page's tests (make test-web)")
fi
if ((${#folders[@]})); then step "tests of ${folders[*]}" tests; fi
for file in "${changed[@]}"; do
  if [[ $(tests_of "$file") == else ]]; then unseen+=("what else $file concerns"); fi
done

printf 'Not looked at: %s\n' "${unseen[@]}"
refuse_failed check
echo "Nothing found in ${SECONDS} s"
