//! A secret that a master shows to a worker on the same machine, which other users of the machine do not have.

use std::fs;
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tonic::metadata::{Ascii, MetadataValue};
use tonic::service::Interceptor;
use tonic::{Request, Status};

/// Where it stands in a request.
const HEADER: &str = "authorization";
const SCHEME: &str = "Bearer ";

/// Least length: 128 bits in hexadecimal digits.
const SHORTEST: usize = 32;
const LONGEST: usize = 1024;

/// Permissions of others than the owner of a file.
const OTHERS: u32 = 0o077;

/// A token. It does not show itself in messages.
#[derive(Clone)]
pub struct Token(Arc<MetadataValue<Ascii>>);

/// Why there is no token.
#[derive(Debug, thiserror::Error)]
pub enum TokenError {
    /// The file cannot be read.
    #[error("cannot read the token {}: {source}; the path counts from the current folder", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// Others know it.
    #[error("the token {} can be read by other users; take that away with chmod 600, and write a new one into it", path.display())]
    Open {
        /// The file.
        path: PathBuf,
    },
    /// It is none.
    #[error(
        "{} holds no token: it must be one line of {SHORTEST} to {LONGEST} letters, digits and signs, as of openssl rand -hex 32",
        path.display()
    )]
    NoToken {
        /// The file.
        path: PathBuf,
    },
}

impl Token {
    /// Reads a file that only its user can read.
    ///
    /// # Errors
    /// [`TokenError`].
    pub fn read(path: &Path) -> Result<Self, TokenError> {
        let path = path.to_owned();
        let read = fs::metadata(&path).and_then(|file| Ok((file, fs::read_to_string(&path)?)));
        let (file, text) = match read {
            Ok(read) => read,
            Err(source) => return Err(TokenError::Unreadable { path, source }),
        };
        if file.permissions().mode() & OTHERS != 0 {
            return Err(TokenError::Open { path });
        }
        let text = text.trim_end();
        let is_token = text.bytes().all(|byte| byte.is_ascii_graphic())
            && (SHORTEST..=LONGEST).contains(&text.len());
        match MetadataValue::try_from(format!("{SCHEME}{text}")) {
            Ok(value) if is_token => Ok(Self(Arc::new(value))),
            _ => Err(TokenError::NoToken { path }),
        }
    }

    /// Compares in a time that does not tell how much is right.
    fn is_shown(&self, shown: &[u8]) -> bool {
        let own = self.0.as_bytes();
        let differs = own.iter().zip(shown).fold(0, |all, (a, b)| all | (a ^ b));
        own.len() == shown.len() && std::hint::black_box(differs) == 0
    }
}

impl std::fmt::Debug for Token {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Token(..)")
    }
}

/// Shows a token with every call, if there is one.
#[derive(Debug, Clone, Default)]
pub struct Showing(pub Option<Token>);

impl Interceptor for Showing {
    fn call(&mut self, mut request: Request<()>) -> Result<Request<()>, Status> {
        if let Some(token) = &self.0 {
            request.metadata_mut().insert(HEADER, (*token.0).clone());
        }
        Ok(request)
    }
}

/// Refuses calls that do not show a token, if one is demanded.
#[derive(Debug, Clone, Default)]
pub struct Demanding(pub Option<Token>);

impl Interceptor for Demanding {
    fn call(&mut self, request: Request<()>) -> Result<Request<()>, Status> {
        let Some(token) = &self.0 else {
            return Ok(request);
        };
        match request.metadata().get(HEADER) {
            Some(shown) if token.is_shown(shown.as_bytes()) => Ok(request),
            Some(_) => Err(Status::unauthenticated(
                "the worker has another token; give both ends the same file",
            )),
            None => Err(Status::unauthenticated(
                "the worker demands a token; give its file with --token (in a scene: security.token)",
            )),
        }
    }
}
