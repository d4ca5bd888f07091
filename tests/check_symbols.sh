#!/bin/sh
# check_symbols.sh NM NAMESPACE OBJECT...
#
# Kernel objects are compiled for more instructions than the machine may have. If the linker could
# share a symbol with other objects (say, the weak copy of an inline function), such code could
# reach the whole program. So each symbol of the objects, weak and local ones included, must be in
# packtrace::NAMESPACE. Undefined symbols must be there too, in another object of the same
# instruction set, or be libc functions that compilers call on their own.
set -u
nm=$1
namespace=$2
shift 2
allowed_undefined='memcpy|memmove|memset|memcmp|__tls_get_addr|_GLOBAL_OFFSET_TABLE_'
# Names as the compiler writes them: _ZN9packtrace4avx2…, and statics inside functions as _ZZN….
ours="^_Z(Z|GVZ?|T[VISH])*N[KVr]*9packtrace${#namespace}${namespace}"

failed=0
[ $# -gt 0 ] || { echo "no kernel objects for $namespace"; exit 1; }
for object in "$@"; do
    symbols=$("$nm" --format=posix "$object") || { echo "nm can't read $object"; exit 1; }
    # Constants with names of the compiler, such as .LC0, are no symbols to the linker.
    names=$(printf '%s\n' "$symbols" | grep -v '^\.L')
    # LLVM's nm also prints a value and a size for undefined symbols, both 0.
    is_undefined='$2 == "U" || ($2 ~ /^[wv]$/ && NF < 4)'
    undefined=$(printf '%s\n' "$names" | awk "$is_undefined"' {print $1}')
    defined=$(printf '%s\n' "$names" | awk "!($is_undefined)"' {print $1}')

    foreign=$(printf '%s\n' "$defined" | grep -Ev "$ours")
    wanted=$(printf '%s\n' "$undefined" | grep -v '^$' | grep -Evx "$allowed_undefined" |
        grep -Ev "$ours")
    ours_count=$(printf '%s\n' "$defined" | grep -Ec "$ours")
    if [ -n "$foreign$wanted" ]; then
        echo "$object: symbols outside packtrace::$namespace:"
        printf '%s\n' "$foreign" "$wanted" | grep -v '^$' | c++filt
        failed=1
    fi
    if [ "$ours_count" -lt 2 ]; then
        echo "$object: nm finds $ours_count symbols of packtrace::$namespace"
        failed=1
    fi
done
[ "$failed" = 0 ] && echo "packtrace::$namespace holds every symbol of its objects"
exit "$failed"
