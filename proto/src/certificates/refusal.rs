//! Why a connection was not made, in words.

use rustls::{AlertDescription, CertificateError, Error};

use super::AUTHORITY;

const SECONDS_OF_A_DAY: f64 = 86_400.0;

/// Why a master has no connection to a worker, and what to do.
pub fn as_seen_by_master(error: &Error) -> String {
    match error {
        Error::InvalidCertificate(error) => {
            format!("the certificate of the worker {}", flaw(error))
        }
        Error::AlertReceived(alert) => alerted(*alert),
        Error::InvalidMessage(_) | Error::InappropriateMessage { .. } => {
            "it speaks plain text; write http:// if that is meant, or start the worker with --certificates"
                .to_owned()
        }
        other => format!("no TLS 1.3 with it: {other}"),
    }
}

/// Why a worker refuses a connection.
pub fn as_seen_by_worker(error: &Error) -> String {
    match error {
        Error::InvalidCertificate(error) => format!("its certificate {}", flaw(error)),
        Error::NoCertificatesPresented => {
            "it shows no certificate; masters name theirs with security.certificates or --certificates"
                .to_owned()
        }
        Error::AlertReceived(alert) => {
            format!("it refuses the certificate of this worker ({alert:?})")
        }
        Error::InvalidMessage(_) | Error::InappropriateMessage { .. } => {
            "it does not speak TLS; masters reach this worker by https://".to_owned()
        }
        other => other.to_string(),
    }
}

/// What is wrong with the own certificate.
pub(super) fn of_own(error: &Error) -> String {
    match error {
        Error::InvalidCertificate(error) => format!("it {}", flaw(error)),
        other => other.to_string(),
    }
}

fn alerted(alert: AlertDescription) -> String {
    let refused = match alert {
        AlertDescription::CertificateExpired => "it has expired, or the clocks differ",
        AlertDescription::UnknownCA | AlertDescription::DecryptError => {
            "it is from another authority than that of the worker"
        }
        AlertDescription::UnsupportedCertificate => "it is not one for a master",
        AlertDescription::CertificateRevoked => "it is revoked",
        AlertDescription::CertificateRequired | AlertDescription::NoCertificate => {
            "none was shown; name a folder of certificates"
        }
        AlertDescription::BadCertificate
        | AlertDescription::CertificateUnknown
        | AlertDescription::AccessDenied => "it does not say why",
        other => return format!("the worker breaks the handshake off ({other:?})"),
    };
    format!(
        "the worker refuses the certificate of this master: {refused}; make those of both ends with one linchpin certificates"
    )
}

fn flaw(error: &CertificateError) -> String {
    match error {
        CertificateError::ExpiredContext { time, not_after } => {
            let seconds = time.as_secs().saturating_sub(not_after.as_secs()) as f64;
            let days = seconds / SECONDS_OF_A_DAY;
            format!("has expired {days:.1} days ago; make new ones with linchpin certificates")
        }
        CertificateError::Expired => {
            "has expired; make new ones with linchpin certificates".to_owned()
        }
        CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => {
            "is not valid yet; do the clocks of both machines agree?".to_owned()
        }
        CertificateError::UnknownIssuer | CertificateError::BadSignature => format!(
            "is from another authority than {AUTHORITY}; make those of both ends with one linchpin certificates"
        ),
        CertificateError::NotValidForNameContext {
            expected,
            presented,
        } => format!(
            "is not for the name {}, but for {}; reach it by one of these, or give linchpin certificates all its names",
            expected.to_str(),
            presented.join(", ")
        ),
        CertificateError::InvalidPurpose | CertificateError::InvalidPurposeContext { .. } => {
            "is for the other end: that of a worker is not for a master, nor the other way round"
                .to_owned()
        }
        CertificateError::Revoked => "is revoked".to_owned(),
        other => format!("is refused: {other}"),
    }
}
