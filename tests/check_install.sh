#!/bin/sh
# check_install.sh WAY CMAKE CXX BUILD SOURCE ISA…
#
# Users' programs get packtrace in the given WAY, set nothing else, and run:
#   prefix                    installs BUILD into BUILD/tests/prefix, without a user's program
#   find_package, pkg_config  from this prefix
#   examples                  from this prefix, with the examples as a project of their own
#   add_subdirectory, fetch_content
#                             from SOURCE, linked with the library already in BUILD: compiling
#                             another one for the instruction sets ISA… would take minutes
set -eu
way=$1
cmake=$2
cxx=$3
build=$4
source=$5
shift 5
isas=$(echo "$*" | tr ' ' ';')
consumer=$source/tests/consumer
prefix=$build/tests/prefix
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Settings of this machine's user must not influence the result.
unset CXXFLAGS CPPFLAGS LDFLAGS CMAKE_PREFIX_PATH CMAKE_BUILD_TYPE PKG_CONFIG_PATH LD_LIBRARY_PATH

fail() {
    printf '%s\n' "$*"
    exit 1
}

# Runs a command and prints its output only if it fails.
quietly() {
    "$@" >"$folder/log" 2>&1 || fail "$*: $(cat "$folder/log")"
}

install_prefix() {
    rm -rf "$prefix"
    # Uninstalling leaves no files, and only folders that others use.
    quietly "$cmake" --install "$build" --prefix "$prefix"
    quietly "$cmake" -D MANIFEST="$build/install_manifest.txt" -P "$source/cmake/uninstall.cmake"
    ! find "$prefix" ! -type d -o -name 'packtrace*' | grep . || fail "uninstall leaves these"
    quietly "$cmake" --install "$build" --prefix "$prefix"
    quietly "$prefix/bin/packtrace" render "$prefix/share/packtrace/scenes/four_spheres.scene" \
        --size 16x16 -o "$folder/picture.png"
    [ -s "$prefix/share/doc/packtrace/LICENSE" ] || fail "no licence is installed"
    for file in bash-completion/completions/packtrace zsh/site-functions/_packtrace \
        fish/vendor_completions.d/packtrace.fish; do
        [ -s "$prefix/share/$file" ] || fail "no share/$file is installed"
    done
    # A man page for the program and for each command.
    for command in $("$prefix/bin/packtrace" --help |
        sed -n '/^S[Uu][Bb]/,$s/^  \([a-z][a-z]*\) .*/-\1/p') ''; do
        [ -s "$prefix/share/man/man1/packtrace$command.1" ] || fail "no packtrace$command.1 is installed"
    done
    # The MPI program with its pages, if it is built.
    if [ -x "$build/packtrace-mpi" ]; then
        quietly "$prefix/bin/packtrace-mpi" render "$prefix/share/packtrace/scenes/four_spheres.scene" \
            --size 16x16 -o "$folder/ranks.png"
        cmp "$folder/picture.png" "$folder/ranks.png" || fail "packtrace-mpi renders another picture"
        for page in '' $("$prefix/bin/packtrace-mpi" --help |
            sed -n '/^S[Uu][Bb]/,$s/^  \([a-z][a-z]*\) .*/-\1/p'); do
            file=$prefix/share/man/man1/packtrace-mpi$page.1
            [ -s "$file" ] || fail "no packtrace-mpi$page.1 is installed"
            [ "$(grep -c "^packtrace-mpi$page " "$file")" = 1 ] || fail "$file has another name: $(cat "$file")"
        done
    fi
    # The component `runtime` works without MPI.
    quietly "$cmake" --install "$build" --prefix "$folder/runtime" --component runtime
    [ -x "$folder/runtime/bin/packtrace" ] || fail "the component runtime lacks packtrace"
    ! find "$folder/runtime" -name '*mpi*' | grep . || fail "the component runtime has these"
    ! ldd "$folder/runtime/bin/packtrace" | grep -i libmpi || fail "packtrace needs MPI"
    # An installation can be moved as a whole.
    ! grep -rlI -e "$build" -e "$source" "$prefix" || fail "these files name the build folder"
}

# configure NAME [OPTION…]: configures the user's project in the folder NAME.
configure() {
    name=$1
    shift
    quietly "$cmake" --no-warn-unused-cli -G Ninja -S "$consumer" -B "$folder/$name" \
        -DCMAKE_CXX_COMPILER="$cxx" -DWAY="$way" "$@"
    ! grep -i warning "$folder/log" || fail "cmake $* warns: $(cat "$folder/log")"
}

# runs PROGRAM COUNT: checks that the program works and needs COUNT (0 or 1) shared libpacktrace.
runs() {
    quietly "$1"
    needed=$(ldd "$1" | grep -c libpacktrace || true)
    [ "$needed" = "$2" ] || fail "$1 needs $needed shared libpacktrace, not $2: $(ldd "$1")"
}

find_package() {
    for kind in default shared static; do
        components=$kind
        [ $kind != default ] || components=
        # Only the static library needs the library's own dependencies for linking.
        disabled=
        [ $kind = static ] || disabled=-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON
        configure $kind -DCMAKE_PREFIX_PATH="$prefix" -DCOMPONENTS=$components $disabled
        quietly "$cmake" --build "$folder/$kind"
        runs "$folder/$kind/consumer" "$([ $kind = static ] && echo 0 || echo 1)"
    done
    # A missing optional component leaves the package usable.
    configure optional -DCMAKE_PREFIX_PATH="$prefix" "-DCOMPONENTS=OPTIONAL_COMPONENTS;wrong"
    # A component or version that is not available causes an error message.
    for options in "-DCOMPONENTS=wrong" "-DVERSION=0.1" "-DVERSION=0.9"; do
        ! "$cmake" -S "$consumer" -B "$folder/wrong" -DCMAKE_CXX_COMPILER="$cxx" -DWAY="$way" \
            -DCMAKE_PREFIX_PATH="$prefix" "$options" >"$folder/log" 2>&1 ||
            fail "find_package takes $options"
        grep -q -e "no component 'wrong'" -e 'version: 0.2' "$folder/log" ||
            fail "$options: $(cat "$folder/log")"
        rm -rf "$folder/wrong"
    done
}

pkg_config() {
    command -v pkg-config >/dev/null || fail "pkg-config is missing; type: sudo apt-get install pkgconf"
    PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name packtrace.pc)")
    export PKG_CONFIG_PATH
    libraries=$(pkg-config --variable=libdir packtrace)
    # The flags must split into words.
    # shellcheck disable=SC2046
    quietly "$cxx" -c "$consumer/main.cpp" -o "$folder/main.o" $(pkg-config --cflags packtrace)
    # shellcheck disable=SC2046
    quietly "$cxx" "$folder/main.o" -o "$folder/shared" $(pkg-config --libs packtrace)
    LD_LIBRARY_PATH=$libraries
    export LD_LIBRARY_PATH
    runs "$folder/shared" 1
    # shellcheck disable=SC2046
    quietly "$cxx" -fno-exceptions "$consumer/no_exceptions.cpp" -o "$folder/no_exceptions" \
        $(pkg-config --cflags --libs packtrace)
    "$folder/no_exceptions" || fail "a program without exceptions does not work"
    # shellcheck disable=SC2046
    quietly "$cxx" "$folder/main.o" -o "$folder/static" \
        "$libraries/libpacktrace.a" -Wl,--as-needed $(pkg-config --static --libs packtrace)
    runs "$folder/static" 0
    # From a folder with a blank in its name, which pkg-config escapes for a shell.
    ln -s "$prefix" "$folder/a prefix"
    blank=$(PKG_CONFIG_PATH=$folder/a\ prefix/${PKG_CONFIG_PATH#"$prefix"/} pkg-config --cflags --libs packtrace)
    echo "$blank" | grep -q 'a.\{1,2\}prefix' || fail "pkg-config names another folder: $blank"
    eval "quietly \"\$cxx\" \"\$consumer/main.cpp\" -o \"\$folder/blank\" $blank"
    runs "$folder/blank" 1
    # The first program of the documentation prints what the page shows.
    sed -n '/^```cpp/,/^```$/{p;/^```$/q}' "$source/docs/library.md" | grep -v '^```' >"$folder/first.cpp"
    sed -n '/^```output/,/^```/p' "$source/docs/library.md" | grep -v '^```' >"$folder/expected"
    # shellcheck disable=SC2046
    quietly "$cxx" "$folder/first.cpp" -o "$folder/first" $(pkg-config --cflags --libs packtrace)
    (cd "$folder" && ./first >printed) || fail "the first program of docs/library.md fails"
    diff "$folder/expected" "$folder/printed" || fail "docs/library.md says what is not printed"
    [ -s "$folder/first.png" ] || fail "the first program of docs/library.md writes no picture"
    # All headers together.
    for header in "$prefix"/include/packtrace/*.hpp; do
        echo "#include <packtrace/$(basename "$header")>"
    done >"$folder/headers.cpp"
    # shellcheck disable=SC2046
    quietly "$cxx" -fsyntax-only -Wall -Wextra -Wpedantic -Werror "$folder/headers.cpp" \
        $(pkg-config --cflags packtrace)
}

examples() {
    quietly "$cmake" -G Ninja -S "$source/examples" -B "$folder/examples" \
        -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$prefix"
    quietly "$cmake" --build "$folder/examples"
    (cd "$folder" && quietly ./examples/picture && [ -s picture.png ]) || fail "no picture"
}

# command_of NAME FILE: prints the command that makes FILE in the user's project NAME.
command_of() {
    ninja -C "$folder/$1" -t commands "$2" | tail -n 1
}

# As a part of another project: compiles the user's program and links it as that project would.
subproject() {
    for kind in static shared; do
        shared=$([ $kind = static ] && echo OFF || echo ON)
        configure $kind -DPACKTRACE_SOURCE="$source" -DPACKTRACE_ISAS="$isas" \
            -DBUILD_SHARED_LIBS="$shared"
        object=CMakeFiles/consumer.dir/main.cpp.o
        quietly ninja -C "$folder/$kind" $object
        # None of packtrace's own flags reaches the user's program.
        ! command_of $kind $object | grep -e ' -f' -e ' -O' -e ' -W' -e ' -m' ||
            fail "flags of packtrace's own compile the program"
        ninja -C "$folder/$kind" -t commands | grep kernels/table.cpp | grep -q -e ' -O[23] ' ||
            fail "kernels are not optimised in a project without a build type"
        ! ninja -C "$folder/$kind" -t commands | grep -e FORTIFY_SOURCE -e protector-strong -e 'z,now' ||
            fail "packtrace hardens another project"
        library=$folder/$kind/packtrace
        [ "$way" = add_subdirectory ] || library=$folder/$kind/_deps/packtrace-build
        cp -P "$build"/src/libpacktrace.* "$library/src"
        (cd "$folder/$kind" && quietly sh -c "$(command_of $kind consumer)")
        runs "$folder/$kind/consumer" "$([ $kind = static ] && echo 0 || echo 1)"
    done
}

# macros_of COMMAND: prints the macros that a compile command predefines.
macros_of() {
    sh -c "${1%% -MD *} -dM -E -x c++ /dev/null"
}

# A project may ask for less exact arithmetic, and for this processor only. packtrace's own sources
# are still compiled with their own flags.
foreign_flags() {
    configure foreign -DPACKTRACE_SOURCE="$source" -DPACKTRACE_ISAS="$isas" \
        "-DFLAGS=-Ofast;-ffast-math;-march=native;-flto"
    ninja -C "$folder/foreign" -t commands | grep -e '/src/kernels/table\.cpp$' -e '/Unity/unity_0_cxx.cxx$' \
        -e '/src/lower/packed_scene\.cpp$' >"$folder/commands"
    [ "$(grep -c kernels/table "$folder/commands")" -gt 0 ] || fail "no kernel is compiled"
    while IFS= read -r command; do
        ! macros_of "$command" | grep -e __FAST_MATH__ -e '__FINITE_MATH_ONLY__ 1' ||
            fail "compiled with -ffast-math: $command"
        case $command in
        *PACKTRACE_ISA=sse42*)
            ! macros_of "$command" | grep __AVX__ || fail "sse42 is compiled for AVX: $command" ;;
        esac
        case $command in
        *kernels/table.cpp)
            echo "$command" | grep -q -e ' -fno-lto' || fail "kernels see link-time optimisation" ;;
        esac
    done <"$folder/commands"
}

case $way in
prefix) install_prefix ;;
find_package) find_package ;;
pkg_config) pkg_config ;;
examples) examples ;;
add_subdirectory)
    subproject
    foreign_flags
    ;;
fetch_content) subproject ;;
*) fail "unknown way '$way'" ;;
esac
