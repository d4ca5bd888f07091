#!/bin/bash
# build_tsan_tbb.sh FOLDER
#
# Builds oneTBB with clang's thread sanitizer, from the source package of the installed version, and
# prints the folder that contains libtbb.so.12. A program that loads this library shows the
# sanitizer in which order tasks run. With the system's library, every result of a task looks like a
# race. Needs Debian or Ubuntu, dpkg-dev, cmake and ninja; installs nothing.
set -euo pipefail
folder=$1
version=$(dpkg-query -W -f '${source:Package}=${source:Version}' libtbb-dev)
mkdir -p "$folder"
folder=$(readlink -f "$folder")

# The system's source lists, with source packages enabled.
apt_for_sources() {
    apt-get -o Dir::State="$folder/apt" -o Dir::Cache="$folder/apt/cache" \
        -o Dir::State::status=/var/lib/dpkg/status -o Dir::Etc::sourcelist="$folder/apt/list" \
        -o Dir::Etc::sourceparts="$folder/apt/parts" -o Debug::NoLocking=1 \
        -o APT::Sandbox::User=root "$@"
}

get_sources() {
    rm -rf "$folder/source" "$folder/build" "$folder"/*.dsc
    mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial" "$folder/apt/parts"
    sed -n 's/^deb /deb-src /p' /etc/apt/sources.list >"$folder/apt/list" 2>/dev/null || true
    local file
    for file in /etc/apt/sources.list.d/*.sources; do
        [ ! -e "$file" ] || sed 's/^Types:.*/Types: deb-src/' "$file" >"$folder/apt/parts/${file##*/}"
    done
    for file in /etc/apt/sources.list.d/*.list; do
        [ ! -e "$file" ] || sed -n 's/^deb /deb-src /p' "$file" >"$folder/apt/parts/${file##*/}"
    done
    apt_for_sources update &&
        (cd "$folder" && apt_for_sources --download-only source "$version") &&
        dpkg-source --no-check -x "$folder"/*.dsc "$folder/source"
}

build_library() {
    cmake -S "$folder/source" -B "$folder/build" -G Ninja \
        -DCMAKE_CXX_COMPILER="${CXX:-clang++}" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF \
        -DTBB_OUTPUT_DIR_BASE=lib &&
        cmake --build "$folder/build" --target tbb &&
        touch "$folder/build/$version"
}

if [ ! -e "$folder/build/$version" ] &&
    ! { get_sources && build_library; } >"$folder/log" 2>&1; then
    cat "$folder/log" >&2
    echo "$0: building oneTBB failed; its output stands above, and in $folder/log" >&2
    exit 1
fi
echo "$folder/build/lib_relwithdebinfo"
