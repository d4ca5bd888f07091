#!/bin/sh
# check_api_comments.sh DOXYGEN DOXYFILE
#
# Doxygen reads the public headers without a warning, and it detects a comment that names a
# parameter its function does not have.
set -eu
doxygen=$1
doxyfile=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# warnings [SETTING]: prints Doxygen's warnings and discards its pages.
warnings() {
    { cat "$doxyfile"
      printf '%s\n' "OUTPUT_DIRECTORY = $folder" "WARN_LOGFILE = $folder/warnings.txt" "$@"
    } >"$folder/Doxyfile"
    "$doxygen" "$folder/Doxyfile" >/dev/null
    cat "$folder/warnings.txt"
}

found=$(warnings)
[ -z "$found" ] || { printf '%s\n' "$found"; exit 1; }

printf '/// Adds.\n/// @param c is none of them\nint add(int a, int b);\n' >"$folder/planted.hpp"
warnings "INPUT = $folder/planted.hpp" | grep -q planted.hpp ||
    { echo "Doxygen does not find a planted fault"; exit 1; }
