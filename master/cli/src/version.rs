//! What this build is.

use std::sync::LazyLock;

use linchpin_proto::version::PROTOCOL;

/// Version, commit and protocol, a line each.
pub static LONG: LazyLock<String> = LazyLock::new(|| {
    let (major, minor) = (PROTOCOL.major, PROTOCOL.minor);
    format!(
        "{}\ncommit    {}\nprotocol  linchpin {major}.{minor}\nfeatures  none optional",
        env!("CARGO_PKG_VERSION"),
        env!("LINCHPIN_COMMIT"),
    )
});
