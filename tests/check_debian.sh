#!/bin/bash
# check_debian.sh SUITE [--root FOLDER] [--packages FOLDER] [CMAKE OPTION…]
#
# Checks docs/library.md on a fresh Debian, in folders that it removes afterwards. SUITE is bookworm
# (Debian 12) or trixie (13). Needs root, and either debootstrap or a FOLDER with a fresh system.
#   1. Sources: installs the packages that ./run install names, builds and installs packtrace, and
#      builds and runs a user's program by find_package, pkg-config, and FetchContent, each
#      compiled. Also builds and installs the Python package, and runs the programs of its page.
#   2. Packages: makes them there, installs them on a second fresh system, runs the program, and
#      builds and runs a user's program there, with the Python package too. With --packages FOLDER
#      it uses existing packages and skips step 1.
# Other options go to CMake, such as -DPACKTRACE_ISAS=avx2. If CCACHE_DIR is set, object files come
# from this cache. CMAKE_BUILD_PARALLEL_LEVEL limits parallel compilation. Not a part of ctest: the
# script builds all of packtrace twice.
set -euo pipefail
[ "$(id -u)" = 0 ] || { echo "check_debian.sh: needs root, for chroot" >&2; exit 2; }
# Private mounts, which end with this script.
[ -n "${PACKTRACE_UNSHARED:-}" ] || PACKTRACE_UNSHARED=1 exec unshare --mount --propagation private \
    "$BASH" "$0" "$@"

suite=${1:?which Debian: bookworm or trixie?}
shift
source=$(dirname "$(dirname "$(readlink -f "$0")")")
root=
packages=
options=()
while [ $# -gt 0 ]; do
    case $1 in
    --root) root=$2 && shift 2 ;;
    --packages) packages=$(readlink -f "$2") && shift 2 ;;
    *) options+=("$1") && shift ;;
    esac
done
work=$(mktemp -d)
# Unmounts first, so that nothing of the machine itself is removed.
clean_up() {
    umount -R "$work"/*/proc "$work"/*/ccache 2>/dev/null || true
    rm -rf --one-file-system "$work"
}
trap clean_up EXIT

# fresh NAME: makes a fresh system in $work/NAME, with this machine's access to Debian's packages.
fresh() {
    local system=$work/$1
    if [ -n "$root" ]; then
        cp -a "$root" "$system"
    else
        debootstrap --variant=minbase "$suite" "$system"
    fi
    grep -q "VERSION_CODENAME=$suite" "$system/etc/os-release"
    cp /etc/resolv.conf /etc/hosts "$system/etc/"
    apt-config dump Acquire::http Acquire::https >"$system/etc/apt/apt.conf.d/90machine"
    echo 'Dpkg::Use-Pty "0";' >>"$system/etc/apt/apt.conf.d/90machine"
    # This system need not survive a power cut; without syncing, dpkg is ten times as fast.
    echo force-unsafe-io >"$system/etc/dpkg/dpkg.cfg.d/unsafe-io"
    mount -t proc proc "$system/proc"
    inside "$1" apt-get update -qq
}

# inside NAME COMMAND…: runs a command in the system, without this machine's environment.
inside() {
    local system=$work/$1 cache=()
    shift
    [ ! -d "$system/ccache" ] || cache=(CCACHE_DIR=/ccache CCACHE_BASEDIR=/packtrace CCACHE_NOHASHDIR=1
        CMAKE_CXX_COMPILER_LAUNCHER=ccache
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime)
    chroot "$system" env -i HOME=/root \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive \
        CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" "${cache[@]}" "$@"
}

step() {
    echo "== $suite: $*"
}

# uses NAME WAY [OPTION…]: configures, builds and runs a user's project in the system.
uses() {
    local name=$1 way=$2
    shift 2
    step "a program by $way"
    inside "$name" sh -ec 'rm -rf /user; cp -r /packtrace/tests/consumer /user
        cmake -S /user -B /user/build "$@"; cmake --build /user/build; /user/build/consumer' \
        user -DWAY="$way" "$@"
}

uses_pkg_config() {
    step "a program by pkg-config"
    inside "$1" sh -ec 'c++ /packtrace/tests/consumer/main.cpp -o /user_program \
        $(pkg-config --cflags --libs packtrace) && /user_program'
}

# Runs the programs of docs/python.md.
uses_python() {
    step "the programs of docs/python.md"
    inside "$1" sh -ec 'mkdir -p /programs && cd /programs &&
        sed -n "/^\`\`\`python/,/^\`\`\`/p" /packtrace/docs/python.md | grep -v "^\`\`\`" >program.py &&
        /usr/bin/python3 program.py && test -s ball.png'
}

copy_sources() {
    mkdir -p "$work/$1/packtrace"
    (cd "$source" && git ls-files -co --exclude-standard | tar cf - -T -) |
        tar xf - -C "$work/$1/packtrace"
}

from_sources() {
    step "a fresh system"
    fresh build
    copy_sources build
    step "./run install"
    inside build /packtrace/run install
    if [ -n "${CCACHE_DIR:-}" ]; then
        inside build apt-get install -y -qq ccache >/dev/null
        mkdir -p "$work/build/ccache"
        mount --bind "$CCACHE_DIR" "$work/build/ccache"
    fi
    step "build and install"
    inside build sh -ec 'cd /packtrace && cmake --preset release -DPACKTRACE_BUILD_TESTS=OFF \
        -DPACKTRACE_BUILD_BENCH=OFF -DPACKTRACE_PYTHON=ON "$@" && cmake --build --preset release &&
        cmake --install build/release >/installed && ldconfig' build "${options[@]}"
    inside build packtrace render /usr/local/share/packtrace/scenes/four_spheres.scene -o /a.png
    uses_python build
    uses build find_package
    uses build find_package -DCOMPONENTS=static
    uses_pkg_config build
    uses build fetch_content -GNinja -DPACKTRACE_SOURCE=/packtrace "${options[@]}"
    step "packages"
    inside build sh -ec 'cd /packtrace/build/release && cpack -B /packages'
    packages=$work/build/packages
}

from_packages() {
    step "packages on a fresh system"
    fresh user
    mkdir "$work/user/packages"
    cp "$packages"/*.deb "$work/user/packages"
    copy_sources user
    inside user sh -ec 'apt-get install -y -qq --no-install-recommends /packages/packtrace_*.deb >/log ||
        { cat /log; exit 1; }'
    inside user packtrace render /usr/share/packtrace/scenes/four_spheres.scene -o /a.png
    inside user sh -ec 'apt-get install -y -qq --no-install-recommends /packages/*.deb g++ cmake make \
        pkgconf >/log || { cat /log; exit 1; }'
    uses_python user
    uses user find_package
    uses user find_package -DCOMPONENTS=static
    uses_pkg_config user
    step "packages go"
    inside user sh -ec 'apt-get remove -y -qq packtrace libpacktrace-dev python3-packtrace >/log
        ! [ -e /usr/bin/packtrace ] && ! [ -e /usr/include/packtrace ] &&
        ! python3 -Ic "import packtrace" 2>/log'
}

[ -n "$packages" ] || from_sources
from_packages
echo "$suite: all works"
