#!/bin/sh
# check_rooms.sh SRC ARCHITECTURE.md
#
# A source folder includes only the folders that the table of docs/architecture.md permits. The
# folders of the kernels ("rooms") have an order, and a file includes only files of its own room or
# of an earlier one. Kernels include kernel_abi, the kernel of the one-dimensional note and
# themselves; no other folder includes them.
set -u
table=$(grep '^| `src/' "$2")
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

# Each line is a folder and the folders that it may include: names in its last column, or all
# folders above it.
above=''
while IFS='|' read -r _ folder _ sees _; do
    folder=$(echo "$folder" | tr -d '` ' | sed 's/^src\///')
    [ -d "$folder" ] || { echo "docs/architecture.md: there is no src/$folder"; failed=1; continue; }
    case $sees in *"all above"*) sees=$above ;; esac
    may=$(echo "$sees" | tr -c 'a-z_\n' '|')
    files=$(find "$folder" -name '*.[hc]pp')
    # shellcheck disable=SC2086
    found=$(includes $files | grep -Ev ":($folder|$may)/" | grep '/.*:.*/')
    [ -z "$found" ] || { echo "src/$folder sees more than docs/architecture.md says:"; echo "$found"; failed=1; }
    above="$above $folder"
done <<EOF
$table
EOF
for folder in */; do
    echo "$table" | grep -q "^| \`src/${folder%/}\`" ||
        { echo "docs/architecture.md does not list src/${folder%/}"; failed=1; }
done

others=$(find . -name '*.[hc]pp' ! -path './kernels/*' ! -path './onedim/onedim_kernel.hpp' \
    ! -path './onedim/bit_transpose.hpp')
# shellcheck disable=SC2086
found=$(includes $others | grep -E ':(kernels/|onedim/(onedim_kernel|bit_transpose))')
[ -z "$found" ] || { echo "kernels are included by nobody else:"; echo "$found"; failed=1; }
exit $failed
