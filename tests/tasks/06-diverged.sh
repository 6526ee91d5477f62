#!/bin/sh
set -e
# docs/guide/when-it-goes-wrong.md, The coupling fails
linchpin run scenes/oscillator.toml --set coupling.degree=2 || test $? -eq 1
linchpin check scenes/oscillator.toml --set coupling.degree=2
linchpin run scenes/oscillator.toml --set coupling.degree=2 --set coupling.index=1
