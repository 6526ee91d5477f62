//! What a connection has seen of the other end, for a call that fails on it.

use std::io;
use std::pin::Pin;
use std::sync::{Arc, OnceLock};
use std::task::{Context, Poll, ready};

use linchpin_proto::certificates::as_seen_by_master;
use linchpin_proto::contract::CallError;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};

/// First bytes of what a server says in TLS: an alert of TLS 1.
const ALERT: [u8; 2] = [21, 3];

/// Why the two ends do not trust each other. Copies see the same.
#[derive(Debug, Clone, Default)]
pub(super) struct Witness(Arc<OnceLock<String>>);

impl Witness {
    /// Takes note of an error, if it is one of trust.
    pub fn see(&self, error: &io::Error) {
        let inner = error.get_ref();
        if let Some(error) = inner.and_then(|inner| inner.downcast_ref::<rustls::Error>()) {
            self.0.get_or_init(|| as_seen_by_master(error));
        }
    }

    pub fn has_seen(&self) -> bool {
        self.0.get().is_some()
    }

    /// The error of a call over the connection: why it came to that, if it was seen.
    pub fn explain(&self, address: &str, error: CallError) -> CallError {
        match (self.0.get(), &error) {
            (Some(reason), CallError::Lost { .. } | CallError::Unreachable { .. }) => {
                CallError::Untrusted {
                    address: address.to_owned(),
                    reason: reason.clone(),
                }
            }
            _ => error,
        }
    }
}

/// A connection that is watched.
pub(super) struct Witnessed<C> {
    bytes: C,
    witness: Witness,
    /// Whether the first answer is still to come, in plain text.
    is_unread: bool,
}

impl<C> Witnessed<C> {
    /// A connection in plain text, at whose other end TLS may be spoken.
    pub fn plain(bytes: C, witness: Witness) -> Self {
        Self {
            bytes,
            witness,
            is_unread: true,
        }
    }

    /// An encrypted connection, whose other end may refuse the certificate that it was shown.
    pub fn encrypted(bytes: C, witness: Witness) -> Self {
        Self {
            is_unread: false,
            ..Self::plain(bytes, witness)
        }
    }
}

impl<C: AsyncRead + Unpin> AsyncRead for Witnessed<C> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        let read = ready!(Pin::new(&mut self.bytes).poll_read(context, buffer));
        if let Err(error) = &read {
            self.witness.see(error);
        }
        if std::mem::take(&mut self.is_unread) && buffer.filled()[before..].starts_with(&ALERT) {
            let reason = "it speaks TLS; write https:// and give certificates, which linchpin certificates makes";
            self.witness.0.get_or_init(|| reason.to_owned());
        }
        Poll::Ready(read)
    }
}

impl<C: AsyncWrite + Unpin> AsyncWrite for Witnessed<C> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.bytes).poll_write(context, bytes)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.bytes).poll_write_vectored(context, slices)
    }

    fn is_write_vectored(&self) -> bool {
        self.bytes.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.bytes).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.bytes).poll_shutdown(context)
    }
}
