#!/bin/bash
# Checks that all C++ files are formatted as .clang-format says.
# Remedy: clang-format-14 -i FILE
cd "$(dirname "$0")/.." || exit 1
formatter=$(command -v clang-format-14) || {
  echo "format: skipped, clang-format-14 is not installed"
  exit 0
}
mapfile -t files < <(find include source tests \( -name '*.h' -o -name '*.cc' \) | sort)
"$formatter" --dry-run --Werror "${files[@]}" 2>&1 |
  grep -o '^[^:]*:[0-9]*:[0-9]*: error' | sort -u -t: -k1,1 | head -n 20
status=${PIPESTATUS[0]}
echo "format: ${#files[@]} files checked, exit code $status"
exit "$status"
