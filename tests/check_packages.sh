#!/bin/sh
# check_packages.sh CPACK BUILD VERSION [PYTHON]
#
# cpack makes Debian packages of BUILD. Each package has its files, its licence and its
# dependencies. The program runs from the unpacked package, and so does the Python package if there
# is a PYTHON.
set -eu
cpack=$1
build=$2
version=$3
python=${4:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
    printf '%s\n' "$*"
    exit 1
}

command -v dpkg-shlibdeps >/dev/null || fail "dpkg-dev is missing; type: sudo apt-get install dpkg-dev"
# Uncompressed: compression takes twice as long as all the rest, and dpkg-deb is responsible for it.
"$cpack" --config "$build/CPackConfig.cmake" -D CPACK_DEBIAN_COMPRESSION_TYPE=none -B "$folder/made" >log 2>&1 || fail "$(cat log)"
! grep -i warning log || fail "cpack warns: $(cat log)"

# has PACKAGE FILE…: checks that the package contains these files below /usr.
has() {
    package=$folder/made/$1_${version}_$(dpkg --print-architecture).deb
    [ -e "$package" ] || fail "no $package; made: $(ls made)"
    name=$1
    shift
    dpkg-deb -c "$package" | sed 's/.* \.\/\(usr\/[^ ]*\).*/\1/' >files
    for file in "$@"; do
        grep -q -x -e "usr/$file" files || fail "$name lacks usr/$file: $(cat files)"
    done
    dpkg-deb -x "$package" root
}
has packtrace bin/packtrace 'lib.*/libpacktrace\.so\.[0-9.]*' share/man/man1/packtrace-render.1.gz \
    share/packtrace/scenes/four_spheres.scene share/bash-completion/completions/packtrace \
    share/zsh/vendor-completions/_packtrace share/doc/packtrace/copyright
dpkg-deb -f "$package" Depends | grep -q 'libtbb.*libpng\|libpng.*libtbb' ||
    fail "packtrace does not depend on its libraries: $(dpkg-deb -f "$package")"
has libpacktrace-dev include/packtrace/render.hpp include/packtrace/version.hpp \
    'lib.*/libpacktrace\.a' 'lib.*/libpacktrace\.so' 'lib.*/pkgconfig/packtrace.pc' \
    'lib.*/cmake/packtrace/packtraceConfig.cmake' share/doc/libpacktrace-dev/copyright
dpkg-deb -f "$package" Depends | grep -q "packtrace (= $version).*libtbb-dev" ||
    fail "libpacktrace-dev does not depend on packtrace: $(dpkg-deb -f "$package")"

if [ -x "$build/packtrace-mpi" ]; then
    ! dpkg-deb -f "$folder/made/packtrace_${version}"_*.deb Depends | grep -i -e openmpi -e mpich ||
        fail "packtrace depends on MPI"
    has packtrace-mpi bin/packtrace-mpi share/man/man1/packtrace-mpi.1.gz \
        share/man/man1/packtrace-mpi-render.1.gz share/doc/packtrace-mpi/copyright
    dpkg-deb -f "$package" Depends | grep -q -e libopenmpi -e libmpich ||
        fail "packtrace-mpi does not depend on MPI: $(dpkg-deb -f "$package")"
fi

root/usr/bin/packtrace render root/usr/share/packtrace/scenes/four_spheres.scene --size 16x16 \
    -o picture.png >log 2>&1 || fail "the packaged program fails: $(cat log)"
[ -s picture.png ] || fail "the packaged program writes no picture"
if [ -n "$python" ]; then
    has python3-packtrace lib/python3/dist-packages/packtrace/__init__.py \
        lib/python3/dist-packages/packtrace/py.typed \
        'lib/python3/dist-packages/packtrace/_packtrace\.cpython-.*\.so'
    dpkg-deb -f "$package" Depends | grep 'python3 (<<' | grep python3-numpy | grep -q libtbb ||
        fail "python3-packtrace depends on: $(dpkg-deb -f "$package" Depends)"
    PYTHONPATH=root/usr/lib/python3/dist-packages "$python" -B -c 'import packtrace
picture = packtrace.render(packtrace.generate_lattice(2), width=8)
assert picture.shape == (8, 8, 3) and "root/usr" in packtrace.__file__' >log 2>&1 ||
        fail "the packaged Python package fails: $(cat log)"
fi
echo "packages: $(ls made/*.deb)"
