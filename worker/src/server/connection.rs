//! Connections whose end is known to those that were called over them.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll};

use linchpin_proto::contract::{Hold, Owner};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tonic::transport::server::Connected;

use crate::cancel::Flag;

/// A connection with the [`Caller`] at its other end; calls find that among their extensions.
pub(super) struct Connection<C> {
    bytes: C,
    caller: Caller,
}

/// Whose calls come over a connection.
#[derive(Clone)]
pub(super) struct Caller {
    /// The connection, which holds instances.
    pub hold: Hold,
    /// Raised at its end.
    pub gone: Flag,
    /// Who calls, where certificates are shown.
    pub owner: Option<Owner>,
}

impl<C> Connection<C> {
    pub fn new(bytes: C, owner: Option<Owner>) -> Self {
        let hold = Hold::connection();
        Self {
            bytes,
            caller: Caller {
                hold,
                gone: Flag::default(),
                owner,
            },
        }
    }
}

impl<C> Drop for Connection<C> {
    fn drop(&mut self) {
        self.caller.hold.end();
        self.caller.gone.raise();
    }
}

impl<C> Connected for Connection<C> {
    type ConnectInfo = Caller;

    fn connect_info(&self) -> Caller {
        self.caller.clone()
    }
}

impl<C: AsyncRead + Unpin> AsyncRead for Connection<C> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.bytes).poll_read(context, buffer)
    }
}

impl<C: AsyncWrite + Unpin> AsyncWrite for Connection<C> {
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
