"""Writes the messages of the contract for Python: python generate.py [FOLDER].

Takes grpcio-tools of the version in tests/python/requirements.txt. The default folder is that of the package, where the
files are under version control; a test generates them anew and compares.
"""

import pathlib
import shutil
import sys
import tempfile

from grpc_tools import protoc

HERE = pathlib.Path(__file__).resolve().parent
FOLDER = HERE / "src" / "linchpin_worker" / "_contract"
SOURCES = {
    "linchpin/v1/worker.proto": HERE.parents[1] / "proto" / "proto",
    "linchpin_worker/wire.proto": HERE / "proto",
}


def generate(folder: pathlib.Path) -> None:
    """Writes worker_pb2 and wire_pb2, each with its types, into `folder`."""
    for name, root in SOURCES.items():
        with tempfile.TemporaryDirectory() as generated:
            options = [f"-I{root}", f"--python_out={generated}", f"--pyi_out={generated}", name]
            if protoc.main(["protoc", *options]) != 0:
                sys.exit(f"generate.py: protoc refuses {root / name}")
            for file in pathlib.Path(generated, name).parent.iterdir():
                shutil.copy(file, folder / file.name)


if __name__ == "__main__":
    generate(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER)
