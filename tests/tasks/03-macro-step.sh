#!/bin/sh
set -e
# docs/guide/examples.md
linchpin run scenes/oscillator.toml --set coupling.macro_step=1e-4 --out out/fine
