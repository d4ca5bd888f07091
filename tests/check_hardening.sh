#!/bin/sh
# check_hardening.sh READELF COMMANDS LEVEL BINARY…
#
# Programs and libraries load at random addresses, bind their symbols at the start and make the
# symbol table read-only. COMMANDS is a compile_commands.json. In it, every source of the library
# and the program has the flags that guard stack frames and copies (_FORTIFY_SOURCE of LEVEL; none
# if LEVEL is empty), and no kernel has them.
set -u
readelf=$1
commands=$2
level=$3
shift 3
failed=0

for binary in "$@"; do
    headers=$("$readelf" -hlW "$binary") || { echo "readelf can't read $binary"; exit 1; }
    dynamic=$("$readelf" -dW "$binary")
    printf '%s\n' "$headers" | grep -q 'Type: *DYN' || { echo "$binary: not position-independent"; failed=1; }
    printf '%s\n' "$headers" | grep -q GNU_RELRO || { echo "$binary: no RELRO"; failed=1; }
    printf '%s\n' "$dynamic" | grep -Eq 'BIND_NOW|FLAGS_1.*NOW' || { echo "$binary: binds late"; failed=1; }
    symbols=$("$readelf" -W --dyn-syms "$binary")
    printf '%s\n' "$symbols" | grep -q __stack_chk_fail || { echo "$binary: guards no frame"; failed=1; }
done
# A small module may have no copy for libc to check; the program, named first, has some.
if [ -n "$level" ] && ! "$readelf" -W --dyn-syms "$1" | grep -Eq '__[a-z]+_chk@'; then
    echo "$1: checks no copy"
    failed=1
fi

lines=$(grep '"command":' "$commands")
of_target() { printf '%s\n' "$lines" | grep -E " -o [^ ]*CMakeFiles/$1\.dir/"; }
guarded() { grep -e ' -fstack-protector-strong ' | { [ -z "$level" ] && cat || grep -e " -D_FORTIFY_SOURCE=$level "; }; }
host=$(of_target '(packtrace_objects|packtrace_cli_objects|packtrace_cli)')
kernels=$(of_target 'packtrace_kernels_[a-z0-9_]+')
hosts=$(printf '%s\n' "$host" | wc -l)
[ "$hosts" -ge 10 ] || { echo "few sources of the host in $commands: $hosts"; failed=1; }
if [ "$(printf '%s\n' "$host" | guarded | wc -l)" != "$hosts" ]; then
    echo "sources without guards:"
    printf '%s\n' "$host" | grep -v -e ' -fstack-protector-strong '
    failed=1
fi
[ -n "$kernels" ] || { echo "no kernels in $commands"; failed=1; }
if printf '%s\n' "$kernels" | grep -e -fstack-protector-strong -e _FORTIFY_SOURCE; then
    echo "kernels with guards, above"
    failed=1
fi
[ "$failed" = 0 ] && echo "$# files and $hosts sources are hardened"
exit "$failed"
