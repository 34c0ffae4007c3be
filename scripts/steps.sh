#!/usr/bin/env bash
# Steps that all run before a script says no. To be sourced.
failed=()

step() {  # NAME COMMAND...
  local name=$1 begin=$SECONDS
  shift
  "$@" || failed+=("$name")
  echo "$name: $((SECONDS - begin)) s"
}

# Ends the script with 1 where a step failed: refuse_failed NAME_OF_THE_SCRIPT.
refuse_failed() {
  if ((${#failed[@]})); then
    printf '%s failed: %s\n' "$1" "${failed[*]}" >&2
    exit 1
  fi
}
