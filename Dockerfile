# One static binary and nothing else. Build it first:
#   cargo build --release --config .cargo/static.toml -p linchpin
FROM scratch
ARG TARGET=x86_64-unknown-linux-gnu
COPY target/${TARGET}/release/linchpin /linchpin
ENTRYPOINT ["/linchpin"]
