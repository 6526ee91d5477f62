#!/usr/bin/env bash
# Makes what the Python workers and their tests need: a venv with the pinned packages, and the stubs of the
# contract. Repeatable; prints nothing when all is there; several callers at once are served one after the other.
#
#   setup.sh [FOLDER]    default: target/python of this checkout
#
# FOLDER/venv/bin/python is the interpreter, FOLDER/stubs belongs into PYTHONPATH.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
top=$(cd "$here/../.." && pwd)
folder=${1:-$top/target/python}
contract=linchpin/v1/worker.proto

mkdir -p "$folder"
exec 9>"$folder/lock"
flock 9

# A stamp is written last, so that an interrupted setup starts again.
if ! cmp -s "$here/requirements.txt" "$folder/venv/requirements.txt"; then
  echo "setup.sh: installing $(tr '\n' ' ' <"$here/requirements.txt")into $folder/venv" >&2
  rm -rf "$folder/venv"
  python3 -m venv "$folder/venv"
  "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check --retries 5 \
    -r "$here/requirements.txt" >&2
  cp "$here/requirements.txt" "$folder/venv/requirements.txt"
fi

proto=$top/proto/proto
stamp=$folder/stubs/stamp
if ! cat "$here/requirements.txt" "$proto/$contract" | cmp -s - "$stamp"; then
  rm -rf "$folder/stubs"
  mkdir -p "$folder/stubs"
  "$folder/venv/bin/python" -m grpc_tools.protoc -I "$proto" \
    --python_out="$folder/stubs" --grpc_python_out="$folder/stubs" "$proto/$contract" >&2
  cat "$here/requirements.txt" "$proto/$contract" >"$stamp"
fi
