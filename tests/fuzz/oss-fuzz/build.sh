#!/bin/bash -eu
# Called by OSS-Fuzz with CXX, CXXFLAGS, LIB_FUZZING_ENGINE, OUT and WORK set.
cmake -S "$SRC/packtrace" -B "$WORK/packtrace" -G Ninja -DCMAKE_BUILD_TYPE=None \
    -DPACKTRACE_FUZZ=ON -DPACKTRACE_ISAS=avx2 -DPACKTRACE_FEATURE_SETS=OFF \
    -DPACKTRACE_INSTALL=OFF -DPACKTRACE_BUILD_BENCH=OFF
cmake --build "$WORK/packtrace" --target packtrace_fuzzers
for fuzzer in "$WORK"/packtrace/tests/fuzz/fuzz_*; do
    [ -x "$fuzzer" ] || continue
    name=$(basename "$fuzzer")
    cp "$fuzzer" "$OUT/"
    (cd "$SRC/packtrace/tests/fuzz/corpus/${name#fuzz_}" && zip -q "$OUT/${name}_seed_corpus.zip" -- *)
    # Fuzzers run without the packages that they were built with: their libraries are copied beside
    # them.
    mkdir -p "$OUT/lib"
    ldd "$fuzzer" | awk '/libtbb|libpng|libdeflate/ {print $3}' | xargs -r cp -L -t "$OUT/lib"
    patchelf --set-rpath "\$ORIGIN/lib" "$OUT/$name"
done
