#!/bin/sh
set -e
# docs/guide/first-scene.md
cat >two-links.toml <<'END'
# two-links.toml
[scene]
name = "two-links"
t_end = 2.0                # seconds

[coupling]
method = "hermite"
macro_step = 1e-2          # seconds

[[subsystem]]
name = "upper"
model = "pendulum"         # hangs on a hinge in the origin
parameters = { m = 1.0, inertia = 0.083, length = 1.0 }

[[subsystem]]
name = "lower"
model = "planar-body"      # a free body; its marker "start" begins at the tip of the upper link
parameters = { m = 1.0, inertia = 0.083, length = 1.0, x0 = 1.0, y0 = 0.0, angle0 = -1.0 }

[[joint]]
name = "hinge"
kind = "revolute"
a = "upper.tip"
b = "lower.start"

[output]
variables = ["upper.energy", "lower.energy"]
END
linchpin check two-links.toml
linchpin run two-links.toml --animate
