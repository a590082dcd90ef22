# lockstep in a container: docker build -t lockstep . && docker run --rm lockstep run trees/door_pulling.xml
# docs/packages.md has more. The first stage makes the Debian packages, the second one installs them, without compilers.
FROM debian:12-slim AS build
COPY . /src
WORKDIR /src
# The time in the packages, for builds that are to be the same bytes: --build-arg SOURCE_DATE_EPOCH=…
ARG SOURCE_DATE_EPOCH
# It installs what it needs, as on any Debian.
RUN ./dev package

FROM debian:12-slim
COPY --from=build /src/build/package/packages/lockstep_*.deb /tmp/
# Beside what it depends on: what compressed recordings, the monitor and leaves in Python need.
RUN apt-get update \
 && apt-get install -y --no-install-recommends /tmp/lockstep_*.deb libmicrohttpd12 libzstd1 python3 \
 && rm -rf /tmp/*.deb /var/lib/apt/lists/* \
 && useradd --uid 1000 --create-home --home-dir /work lockstep \
 && ln -s /usr/share/lockstep/trees /work/trees
# A number, so that Kubernetes sees that it is not root; bars and marks need UTF-8.
USER 1000
ENV LANG=C.UTF-8
WORKDIR /work
ENTRYPOINT ["lockstep"]
CMD ["--help"]
