#!/bin/sh
# check_run.sh RUN
#
# What ./run installs, prints and returns on a machine whose apt-get, dpkg-query and cmake are
# scripts of this test. Nothing is installed or built.
set -u
run=$1
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin" "$folder/project"
cp "$run" "$folder/project/run"
cd "$folder/project" || exit 1
PATH=$folder/bin:$PATH
unset CI CXX

failed=0
# A fake program of this machine: its name, then the lines of its script.
fake() {
    name=$1
    shift
    { echo '#!/bin/sh' && printf '%s\n' "$@"; } >"$folder/bin/$name"
    chmod +x "$folder/bin/$name"
}
# A run of ./run with its expected exit status.
ends() {
    expected=$1
    shift
    ./run "$@" >"$folder/printed" 2>&1
    status=$?
    [ "$status" = "$expected" ] || wrong "./run $* ends with status $status, not $expected"
}
wrong() {
    echo "$1; it printed:"
    cat "$folder/printed"
    failed=1
}
prints() {
    grep -q -e "$1" "$folder/printed" || wrong "nothing printed of: $1"
}
prints_no() {
    ! grep -q -e "$1" "$folder/printed" || wrong "printed: $1"
}

fake dpkg-query 'exit 1'
fake sudo 'exec "$@"'
fake apt-get 'echo "noise of apt-get"'
# A fake cmake that sets up a build folder, and builds a program that prints its arguments.
fake cmake 'case $1 in' \
    '--preset) mkdir -p build/release; echo "$@" >>configured ;;' \
    '*) echo "[1/1] Building noise"' \
    '   printf "#!/bin/sh\\necho packtrace \\"\\$@\\"\\n" >build/release/packtrace' \
    '   chmod +x build/release/packtrace ;;' \
    'esac'

# The demo needs neither the packages for tests nor those for reports and truths.
ends 0 demo --size 8x8
prints 'Installing .*libtbb-dev'
for package in catch2 benchmark qemu gnuplot boost; do
    prints_no "$package"
done
prints 'the first time takes about'
prints_no noise
grep -q noise build/apt.log || wrong 'apt-get leaves no log'
grep -q noise build/build.log || wrong 'the build leaves no log'
prints 'packtrace demo scenes/four_spheres.scene -o demo --size 8x8'
prints "The picture is $PWD/demo/four_spheres.png"
prints "The program is $PWD/build/release/packtrace"
prints 'Try next:'
grep -q STUDY=OFF configured || wrong 'the demo builds the study'
if [ "$(uname -m)" = x86_64 ]; then
    grep -qE 'ISAS=(one_lane;avx2|sse42$)' configured ||
        wrong 'the demo does not build the instruction sets of this processor'
    grep -q sse_fma configured && wrong 'the demo builds what only comparisons need'
fi

# ./run build always builds all instruction sets, even after a demo.
rm configured
ends 0 build
grep -q 'STUDY=ON.*ISAS=all' configured || wrong 'not all instruction sets are built'
rm configured

# A complete build folder keeps its configuration.
echo PACKTRACE_BUILD_STUDY:BOOL=ON >build/release/CMakeCache.txt
touch build/release/build.ninja
ends 0 demo
grep -q -e STUDY -e ISAS configured && wrong 'the demo takes the study away'
prints_no 'the first time'

ends 0 install
prints 'catch2'

# The sanitizers are those of clang, in the version that CXX names.
fake ctest 'echo "ctest $@"'
rm configured
ends 0 sanitize -R image
prints 'Installing .* libclang-rt-dev'
prints '^ctest --preset asan -L fast .*-R image'
grep -q 'preset asan .*CMAKE_CXX_COMPILER=clang++' configured || wrong 'no sanitizers of clang'
CXX=clang++-19
export CXX
ends 0 sanitize
prints 'Installing .* libclang-rt-19-dev'
unset CXX

# The thread tests load the oneTBB that a script builds; this fake script prints its folder.
mkdir tests
fake ../project/tests/build_tsan_tbb.sh 'echo "/built in $1"'
fake ctest 'echo "ctest $@ loads from $LD_LIBRARY_PATH"'
ends 0 sanitize thread -R bvh
prints '^ctest --preset tsan -L fast .*-R bvh loads from /built in build/tsan_tbb'
grep -q 'preset tsan .*CMAKE_CXX_COMPILER=clang++' configured || wrong 'no thread sanitizer of clang'
fake ../project/tests/build_tsan_tbb.sh 'echo "no sources" >&2' 'exit 1'
ends 1 sanitize thread
prints 'no sources'
prints_no '^ctest'

# A failed step shows its output.
fake apt-get 'echo "noise of apt-get"' 'exit 100'
ends 1 demo
prints 'noise of apt-get'
prints 'Could not install'
fake dpkg-query 'echo installed'
fake cmake 'echo "noise of cmake"' 'exit 1'
ends 1 demo
prints 'noise of cmake'
prints 'setting up the build failed'
fake cmake 'case $1 in --preset) ;; *) echo "noise of ninja"; exit 1 ;; esac'
ends 1 demo
prints 'noise of ninja'
prints 'the build failed'
rm -f configured
ends 2 build all
prints "./run build: takes no options, but 'all'"
ends 2 fuzz soon
prints "'soon' is no number of seconds"
ends 0 install --help
prints '^./run install  *install the packages'
[ ! -e configured ] || wrong 'what was only asked about was built'
ends 2 dmeo
prints "unknown command 'dmeo'"
exit "$failed"
