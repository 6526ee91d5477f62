#!/bin/sh
set -e
# docs/guide/reading-results.md, Two runs
linchpin run scenes/oscillator.toml
linchpin run scenes/oscillator.toml --set coupling.macro_step=5e-4 --out out/fine
linchpin diff out/oscillator out/fine --tolerance 0.1 || test $? -eq 1
