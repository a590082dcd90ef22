# lockstep in a container: docker build -t lockstep . && docker run --rm lockstep run trees/door_pulling.xml
# The first stage makes the Debian packages, the second one installs them, without compilers.
FROM debian:12-slim AS build
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates
COPY . /src
WORKDIR /src
RUN ./dev package

FROM debian:12-slim
COPY --from=build /src/build/package/packages/lockstep_*.deb /tmp/
# Recommends: what compressed recordings, the monitor and leaves in Python need.
RUN apt-get update \
 && apt-get install -y --no-install-recommends /tmp/lockstep_*.deb libmicrohttpd12 libzstd1 python3 \
 && rm -rf /tmp/*.deb /var/lib/apt/lists/* \
 && useradd --system --create-home --home-dir /work lockstep
USER lockstep
WORKDIR /work
RUN ln -s /usr/share/lockstep/trees trees
ENTRYPOINT ["lockstep"]
CMD ["--help"]
