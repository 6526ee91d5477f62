#!/bin/sh
set -e
# docs/guide/reading-results.md, In ParaView
linchpin run scenes/four-bar.toml --animate
linchpin export out/four-bar --format vtk
