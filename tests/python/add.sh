#!/usr/bin/env bash
# Adds the pinned packages of requirements-NAME.txt to the venv of setup.sh; repeatable, prints nothing when all is there.
#
#   add.sh NAME [FOLDER]    FOLDER as for setup.sh
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
list=$here/requirements-$1.txt
folder=${2:-$(cd "$here/../.." && pwd)/target/python}

bash "$here/setup.sh" "$folder"
exec 9>"$folder/lock"
flock 9
stamp=$folder/venv/requirements-$1.txt
if ! cmp -s "$list" "$stamp"; then
  echo "add.sh: installing $(tr '\n' ' ' <"$list")into $folder/venv" >&2
  "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check --retries 5 \
    -c "$here/requirements.txt" -r "$list" >&2
  cp "$list" "$stamp"
fi
