#!/bin/sh
set -e
# docs/guide/reading-results.md, In pandas
linchpin run scenes/oscillator.toml
cat >read.py <<'END'
# read.py
import json

import pandas

table = pandas.read_csv("out/oscillator/results.csv", index_col="t", float_precision="round_trip")
columns = json.load(open("out/oscillator/run.json"))["columns"]
units = {column["name"]: column["unit"] for column in columns}
print(table["mass1.x"].iloc[-1], units["mass1.x"])
END
python read.py
