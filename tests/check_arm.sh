#!/bin/bash
# check_arm.sh [--build FOLDER] [--x86 PROGRAM] [CTEST OPTION…]
#
# Builds packtrace for 64-bit Arm with Debian's cross compiler and runs the quick tests under
# qemu-aarch64. With --x86, a packtrace built for this machine, it also renders pictures with both
# programs: if this machine has fused multiply-add, the pictures must agree bit for bit. FOLDER
# (default build/arm) keeps the Arm packages and the build. On Debian and Ubuntu the script installs
# the cross compiler and the emulator if they are missing. It unpacks the Arm packages into FOLDER
# and changes nothing else on the machine.
set -euo pipefail
source=$(dirname "$(dirname "$(readlink -f "$0")")")
build=$source/build/arm
x86=
while [ $# -gt 0 ]; do
    case $1 in
    --build) build=$(readlink -f "$2") && shift 2 ;;
    --x86) x86=$(readlink -f "$2") && shift 2 ;;
    *) break ;;
    esac
done
sysroot=$build/sysroot

install_tools() {
    local as_root=() missing=()
    [ "$(id -u)" = 0 ] || as_root=(sudo)
    command -v aarch64-linux-gnu-g++ >/dev/null || missing+=(g++-aarch64-linux-gnu)
    command -v qemu-aarch64 >/dev/null || command -v qemu-aarch64-static >/dev/null ||
        missing+=(qemu-user)
    [ "${#missing[@]}" != 0 ] || return 0
    "${as_root[@]}" apt-get update
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y --no-install-recommends "${missing[@]}"
}

# apt with its own list of packages, as on an empty Arm machine.
apt_for_arm() {
    local state=$build/apt
    mkdir -p "$state/lists/partial" "$state/cache/archives/partial"
    touch "$state/status"
    apt-get -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State="$state" \
        -o Dir::State::status="$state/status" -o Dir::State::lists="$state/lists" \
        -o Dir::Cache="$state/cache" -o APT::Install-Recommends=false -o Debug::NoLocking=1 "$@"
}

unpack_packages() {
    [ ! -e "$sysroot/.complete" ] || return 0
    apt_for_arm update
    apt_for_arm --download-only -y install "libstdc++-$(aarch64-linux-gnu-g++ -dumpversion)-dev" \
        libtbb-dev libpng-dev libdeflate-dev libboost-dev libxsimd-dev libglm-dev tao-pegtl-dev \
        libcli11-dev nlohmann-json3-dev libstb-dev catch2
    mkdir -p "$sysroot"
    local package
    for package in "$build"/apt/cache/archives/*.deb; do
        dpkg -x "$package" "$sysroot"
    done
    touch "$sysroot/.complete"
}

# The pictures of both machines must agree in every bit if the x86 machine has fused operations.
compare_pictures() {
    local work scene way
    work=$(mktemp -d)
    for scene in "$source"/scenes/*.scene; do
        for way in "single --accuracy exact" "single --accuracy fast" double; do
            for program in "$x86" "$build/packtrace_emulated"; do
                # $way must split into words.
                # shellcheck disable=SC2086
                "$program" render "$scene" --size 96x72 --precision $way -q \
                    -o "$work/$(basename "$program").pfm"
            done
            cmp "$work/$(basename "$x86").pfm" "$work/packtrace_emulated.pfm"
        done
        echo "same bits: $(basename "$scene")"
    done
    rm -rf "$work"
}

install_tools
unpack_packages
# In emulation, files that no test reads cost time: no man pages, no installation.
cmake -S "$source" -B "$build" -G Ninja \
    -DCMAKE_TOOLCHAIN_FILE="$source/cmake/aarch64-linux-gnu.cmake" -DPACKTRACE_SYSROOT="$sysroot" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 -DPACKTRACE_INSTALL=OFF -DPACKTRACE_BUILD_BENCH=OFF
cmake --build "$build"
[ -z "$x86" ] || compare_pictures
ctest --test-dir "$build" -L fast --output-on-failure -j "$(nproc)" "$@"
