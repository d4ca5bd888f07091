# An image with the program packtrace, installed from its Debian package.
#   docker build -t packtrace .
#   docker run --rm -v "$PWD:/data" packtrace render a.scene -o a.png
FROM debian:13 AS build
WORKDIR /packtrace
COPY . .
RUN ./run install
RUN cmake --preset release -DPACKTRACE_BUILD_TESTS=OFF -DPACKTRACE_BUILD_BENCH=OFF \
    && cmake --build --preset release \
    && cd build/release && cpack -B /packages

FROM debian:13-slim
COPY --from=build /packages/packtrace_*.deb /packages/
RUN apt-get update \
    && apt-get install -y --no-install-recommends /packages/packtrace_*.deb \
    && rm -rf /packages /var/lib/apt/lists/*
WORKDIR /data
ENTRYPOINT ["packtrace"]
