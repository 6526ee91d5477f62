#!/bin/sh
set -e
# docs/guide/reading-results.md, Pictures
linchpin run scenes/oscillator.toml
linchpin plot out/oscillator --list
linchpin plot out/oscillator --columns mass1.x --file position.svg
