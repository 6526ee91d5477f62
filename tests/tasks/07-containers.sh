#!/bin/sh
set -e
# docs/guide/deployment.md, in a clone of the repository
cargo build --release --config .cargo/static.toml -p linchpin
docker-compose up --build --exit-code-from master master
mkdir -p out/compose
docker cp "$(docker-compose ps --all --quiet master)":/out/. out/compose
docker-compose down --volumes
