#!/bin/sh
# check_rooms.sh SRC
#
# The rooms of the kernels stand in an order (docs/architecture.md), and a file includes only what
# is in its own room or in one before it. Kernels see kernel_abi, the kernel of the one-dimensional
# note and themselves; nobody else includes them.
set -u
cd "$1" || exit 1
rooms='simd stats geometry precision lists bvh retrace shade stream fused'

includes() { grep -Ho '#include "[^"]*"' "$@" | sed 's/#include //; s/"//g'; }
failed=0

seen=''
for room in $rooms; do
    seen="$seen|$room"
    files=$(find "kernels/$room" -name '*.hpp')
    [ -n "$files" ] || { echo "kernels/$room is empty"; exit 1; }
    # shellcheck disable=SC2086
    found=$(includes $files | grep -Ev ":(kernel_abi/|kernels/(${seen#|})/)")
    [ -z "$found" ] || { echo "not of kernel_abi, of its room or of one before it:"; echo "$found"; failed=1; }
done

known=$(echo "$rooms" | tr ' ' '|')
strays=$(find kernels -mindepth 1 -maxdepth 1 -type d | grep -Ev "^kernels/($known)$")
[ -z "$strays" ] || { echo "rooms without an order: $strays"; failed=1; }

found=$(includes onedim/onedim_kernel.hpp onedim/bit_transpose.hpp |
    grep -Ev ':(kernel_abi/|kernels/simd/|onedim/bit_transpose)')
[ -z "$found" ] || { echo "more than kernel_abi and kernels/simd:"; echo "$found"; failed=1; }

others=$(find . -name '*.[hc]pp' ! -path './kernels/*' ! -path './onedim/onedim_kernel.hpp' \
    ! -path './onedim/bit_transpose.hpp')
# shellcheck disable=SC2086
found=$(includes $others | grep -E ':(kernels/|onedim/(onedim_kernel|bit_transpose))')
[ -z "$found" ] || { echo "kernels are included by nobody else:"; echo "$found"; failed=1; }
exit $failed
