#!/bin/sh
set -e
# docs/guide/recovery.md
linchpin run scenes/double-pendulum.toml --set coupling.macro_step=5e-5 --set run.checkpoint_steps=100 & # interrupted
until test "$(wc -l <out/double-pendulum/results.csv)" -gt 300; do sleep 0.01; done 2>/dev/null
kill $! && ! wait $!
linchpin run scenes/double-pendulum.toml --set coupling.macro_step=5e-5 --set run.checkpoint_steps=100 --resume
