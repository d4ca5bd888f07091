#!/bin/sh
# check_library.sh AR LIBRARY FILE...
#
# The static library contains exactly these object files, unchanged. So the checks of their
# instructions hold for the library.
set -u
ar=$1
library=$2
shift 2

held=$("$ar" p "$library" | cksum) || exit 1
given=$(cat "$@" | cksum) || exit 1
if [ "$("$ar" t "$library" | wc -l)" != $# ] || [ "$held" != "$given" ]; then
    echo "$library holds other objects than those whose instructions are checked, or in another order:"
    "$ar" t "$library"
    echo "checked:"
    printf '%s\n' "$@"
    exit 1
fi
echo "$library: $# objects"
