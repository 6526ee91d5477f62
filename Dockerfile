# One static binary, an empty folder for results, and nothing else. Build the binary first:
#   cargo build --release --config .cargo/static.toml -p linchpin
FROM scratch AS folder
WORKDIR /out

FROM scratch
ARG TARGET=x86_64-unknown-linux-gnu
# A new volume takes its owner from the folder that it covers.
COPY --from=folder --chown=65532:65532 /out /out
COPY target/${TARGET}/release/linchpin /linchpin
USER 65532:65532
ENTRYPOINT ["/linchpin"]
