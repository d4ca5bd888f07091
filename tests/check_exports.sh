#!/bin/sh
# check_exports.sh NM OBJDUMP LIBRARY HEADERS
#
# The shared library exports exactly the functions that public headers mark with PACKTRACE_API, and
# its name contains the versions that it is compatible with.
set -u
nm=$1
objdump=$2
library=$3
headers=$4
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT

# Names of functions: the text before the first parenthesis.
sed -n 's/.*PACKTRACE_API[^(]*[ *&]\(operator=\|[~A-Za-z_0-9]*\)(.*/\1/p' "$headers"/*.hpp |
    sort -u >"$folder/offered"
# "packtrace::Image<float> packtrace::render<float>(packtrace::Scene const&)" becomes render.
"$nm" -DC --defined-only "$library" | sed 's/^[^ ]* [A-Za-z] //' >"$folder/symbols"
grep -v '^\(typeinfo\|typeinfo name\|vtable\) for packtrace::[A-Za-z]*Error$' "$folder/symbols" |
    sed -e ':again' -e 's/<[^<>]*>//g' -e 'tagain' -e 's/(.*//' -e 's/\[abi:cxx11\]//' -e 's/.*:://' |
    sort -u >"$folder/exported"

failed=0
# Declarations at the start of a line that are neither marked nor defined in the header.
unmarked=$(grep -nE '^(\[\[nodiscard\]\]|void|bool|int|double) .*\(' "$headers"/*.hpp |
    grep -v -e PACKTRACE_API -e ' inline ' -e ' Image<To> convert(')
if [ -n "$unmarked" ]; then
    echo "functions without PACKTRACE_API:"
    echo "$unmarked"
    failed=1
fi
[ "$(wc -l <"$folder/offered")" -ge 20 ] || { echo "few functions are offered"; failed=1; }
if ! diff "$folder/offered" "$folder/exported" >"$folder/difference"; then
    echo "offered by headers (<) and exported (>) differ:"
    cat "$folder/difference"
    failed=1
fi
soname=$("$objdump" -p "$library" | sed -n 's/^ *SONAME *//p')
expected=$(basename "$library" | sed 's/^\(libpacktrace\.so\.[0-9]*\.[0-9]*\)\.[0-9]*$/\1/')
if [ "$soname" != "$expected" ]; then
    echo "the library is named $soname, not $expected"
    failed=1
fi
[ "$failed" = 0 ] && echo "$(wc -l <"$folder/exported") names are exported"
exit "$failed"
