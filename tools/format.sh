#!/usr/bin/env bash
# Formats the tree (default) or, with --check, lists what is not formatted and fails.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -d '' files < <(find include src tests fuzz tools -name '*.[ch]pp' -print0 2>/dev/null)
if [ "${1:-}" = "--check" ]; then
    clang-format --dry-run -Werror "${files[@]}"
else
    clang-format -i "${files[@]}"
fi
