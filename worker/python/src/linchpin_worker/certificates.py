"""Certificates by which masters and this worker know each other."""

from __future__ import annotations

import pathlib
import ssl

import grpc

from .address import ListenError

AUTHORITY, CERTIFICATE, KEY = "ca.crt", "tls.crt", "tls.key"
"""The files of a folder of certificates, as `linchpin certificates` makes it."""


def credentials(folder: str) -> grpc.ServerCredentials:
    """What a server shows and demands: only masters whose certificate is from the same authority are served."""
    authority, certificate, key = (read(pathlib.Path(folder) / name) for name in (AUTHORITY, CERTIFICATE, KEY))
    try:
        # gRPC finds mistakes only when somebody connects, and keeps them to itself.
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(pathlib.Path(folder) / CERTIFICATE, pathlib.Path(folder) / KEY)
        context.load_verify_locations(pathlib.Path(folder) / AUTHORITY)
    except ssl.SSLError as error:
        wrong = f"the certificates in {folder} cannot be used: {error.reason or error}"
        raise ListenError(f"{wrong}; make new ones with linchpin certificates") from error
    return grpc.ssl_server_credentials([(key, certificate)], root_certificates=authority, require_client_auth=True)


def read(path: pathlib.Path) -> bytes:
    """A file of the folder."""
    try:
        return path.read_bytes()
    except OSError as error:
        files = f"a folder of certificates has {AUTHORITY}, {CERTIFICATE} and {KEY}, as linchpin certificates makes them"
        raise ListenError(f"cannot read {path}: {error.strerror}; {files}") from error


def owner_of(context: grpc.ServicerContext) -> bytes | None:
    """The certificate of the caller; None where none is shown."""
    shown = context.auth_context().get("x509_pem_cert")
    return next(iter(shown), None) if shown else None
