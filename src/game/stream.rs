//! Bytes of games, unpacked where they are compressed. What a stream is, is told by its first
//! bytes, never by its name.

use std::fmt::{self, Display};
use std::io::{self, BufRead, BufReader, Cursor, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use bzip2::bufread::MultiBzDecoder;
use flate2::bufread::MultiGzDecoder;
use ruzstd::decoding::errors::{FrameDecoderError, ReadFrameHeaderError};
use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};

/// How a stream is packed. Of all but the first three games are not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Zstd,
    Gzip,
    Bzip2,
    Xz,
    Zip,
    SevenZip,
    Rar,
}

/// So many bytes tell what a stream is.
const MAGIC: usize = 10;

impl Format {
    /// What the first bytes of a stream tell, if it is packed.
    pub fn of(beginning: &[u8]) -> Option<Format> {
        match beginning {
            // A frame, or one that is to be skipped.
            [0x28, 0xB5, 0x2F, 0xFD, ..] | [0x50..=0x5F, 0x2A, 0x4D, 0x18, ..] => {
                Some(Format::Zstd)
            }
            [0x1F, 0x8B, ..] => Some(Format::Gzip),
            // Behind it a block begins, or the end.
            [b'B', b'Z', b'h', b'1'..=b'9', 0x31, 0x41, 0x59, 0x26, 0x53, 0x59, ..]
            | [b'B', b'Z', b'h', b'1'..=b'9', 0x17, 0x72, 0x45, 0x38, 0x50, 0x90, ..] => {
                Some(Format::Bzip2)
            }
            [0xFD, b'7', b'z', b'X', b'Z', 0, ..] => Some(Format::Xz),
            [b'P', b'K', 3, 4, ..] => Some(Format::Zip),
            [b'7', b'z', 0xBC, 0xAF, 0x27, 0x1C, ..] => Some(Format::SevenZip),
            [b'R', b'a', b'r', b'!', 0x1A, 7, ..] => Some(Format::Rar),
            _ => None,
        }
    }
}

impl Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Format::Zstd => "zstd",
            Format::Gzip => "gzip",
            Format::Bzip2 => "bzip2",
            Format::Xz => "xz",
            Format::Zip => "zip",
            Format::SevenZip => "7z",
            Format::Rar => "rar",
        })
    }
}

/// What is wrong with a packed stream. It comes as the inner error of an [`io::Error`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the {format} stream {}", if *.is_cut { "ends early" } else { "is damaged" })]
pub struct StreamError {
    pub format: Format,
    pub is_cut: bool,
}

impl StreamError {
    /// The error of a stream, if it is that and not one of the disk.
    pub fn of(error: &io::Error) -> Option<StreamError> {
        error.get_ref()?.downcast_ref().copied()
    }
}

/// A stream with a look at its first bytes.
pub struct Stream {
    pub reader: Box<dyn Read + Send>,
    /// All that is known before games are read: at least [`MAGIC`] bytes, if there are so many.
    pub beginning: Vec<u8>,
    pub format: Option<Format>,
}

impl Stream {
    /// Looks at a stream, and unpacks it where that can be done.
    pub fn new(mut reader: Box<dyn Read + Send>) -> io::Result<Stream> {
        let beginning = beginning(&mut reader)?;
        let format = Format::of(&beginning);
        let packed: Box<dyn Read + Send> = Box::new(Cursor::new(beginning.clone()).chain(reader));
        let end = End::default();
        let watched = BufReader::with_capacity(BUFFER, Watched { packed, end: end.clone() });
        let unpacked: Box<dyn Read + Send> = match format {
            Some(Format::Zstd) => Box::new(Frames::new(watched)),
            Some(Format::Gzip) => Box::new(MultiGzDecoder::new(watched)),
            Some(Format::Bzip2) => Box::new(MultiBzDecoder::new(watched)),
            other => {
                let reader = Box::new(watched.into_inner().packed);
                return Ok(Stream { reader, beginning, format: other });
            }
        };
        let format = format.unwrap_or(Format::Zstd);
        let mut unpacked = Unpacked { unpacked, format, end };
        let beginning = self::beginning(&mut unpacked)?;
        let reader = Box::new(Cursor::new(beginning.clone()).chain(unpacked));
        Ok(Stream { reader, beginning, format: Some(format) })
    }
}

/// The first bytes of a stream: what one reading gives, or more where that is too few.
fn beginning(reader: &mut impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = vec![0; BUFFER];
    let mut length = 0;
    while length < MAGIC {
        match reader.read(&mut bytes[length..]) {
            Ok(0) => break,
            Ok(read) => length += read,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            // What came before it is read; then the error comes again.
            Err(_) if length > 0 => break,
            Err(error) => return Err(error),
        }
    }
    bytes.truncate(length);
    Ok(bytes)
}

/// How many bytes are read at once.
const BUFFER: usize = 64 * 1024;

/// How the packed bytes came to an end, told from who reads them to who reads what they hold.
#[derive(Clone, Default)]
struct End(Arc<AtomicU8>);

impl End {
    const REACHED: u8 = 1;
    const FAILED: u8 = 2;

    fn set(&self, how: u8) {
        self.0.store(how, Ordering::Relaxed);
    }

    fn is(&self, how: u8) -> bool {
        self.0.load(Ordering::Relaxed) == how
    }
}

/// Packed bytes whose end is told.
struct Watched {
    packed: Box<dyn Read + Send>,
    end: End,
}

impl Read for Watched {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.packed.read(buffer);
        match &read {
            Ok(0) => self.end.set(End::REACHED),
            Err(error) if error.kind() != io::ErrorKind::Interrupted => self.end.set(End::FAILED),
            _ => {}
        }
        read
    }
}

/// What packed bytes hold; any error but one of the disk is a [`StreamError`].
struct Unpacked {
    unpacked: Box<dyn Read + Send>,
    format: Format,
    end: End,
}

impl Read for Unpacked {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.unpacked.read(buffer).map_err(|error| {
            if error.kind() == io::ErrorKind::Interrupted || self.end.is(End::FAILED) {
                return error;
            }
            let is_cut = self.end.is(End::REACHED);
            io::Error::other(StreamError { format: self.format, is_cut })
        })
    }
}

/// Zstandard frames one after the other; those that are to be skipped are.
struct Frames<R> {
    packed: R,
    decoder: FrameDecoder,
    is_within: bool,
    /// What ended a frame early; it is told when all that was unpacked before has been read.
    error: Option<io::Error>,
}

/// The end of a frame: a last block with nothing in it, and a checksum.
const LAST: &[u8] = b"\x01\0\0\0\0\0\0";

impl<R: BufRead> Frames<R> {
    fn new(packed: R) -> Frames<R> {
        Frames { packed, decoder: FrameDecoder::new(), is_within: false, error: None }
    }

    /// Begins the next frame; `false` if there is none.
    fn begin(&mut self) -> io::Result<bool> {
        while !self.packed.fill_buf()?.is_empty() {
            match self.decoder.reset(&mut self.packed) {
                Ok(()) => {
                    self.is_within = true;
                    return Ok(true);
                }
                Err(FrameDecoderError::ReadFrameHeaderError(ReadFrameHeaderError::SkipFrame {
                    length,
                    ..
                })) => {
                    let length = u64::from(length);
                    let skipped = io::copy(&mut (&mut self.packed).take(length), &mut io::sink())?;
                    if skipped < length {
                        return Err(io::ErrorKind::UnexpectedEof.into());
                    }
                }
                Err(error) => return Err(io::Error::other(error)),
            }
        }
        Ok(false)
    }
}

impl<R: BufRead> Read for Frames<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            if self.decoder_is_done() {
                if let Some(error) = self.error.take() {
                    self.is_within = false;
                    return Err(error);
                }
                if self.is_within && !checksum_fits(&self.decoder) {
                    return Err(io::ErrorKind::InvalidData.into());
                }
                self.is_within = false;
                if !self.begin()? {
                    return Ok(0);
                }
            }
            while self.decoder.can_collect() == 0 && !self.decoder.is_finished() {
                let one = BlockDecodingStrategy::UptoBlocks(1);
                if let Err(error) = self.decoder.decode_blocks(&mut self.packed, one) {
                    // The decoder keeps a window of what it has unpacked, until the frame has ended.
                    let all = BlockDecodingStrategy::All;
                    let ended =
                        self.decoder.is_finished() || self.decoder.decode_blocks(LAST, all).is_ok();
                    self.error = Some(io::Error::other(error));
                    self.is_within = ended;
                    break;
                }
            }
            // A frame may hold nothing.
            let read = self.decoder.read(buffer)?;
            if read > 0 || buffer.is_empty() {
                return Ok(read);
            }
        }
    }
}

impl<R> Frames<R> {
    fn decoder_is_done(&self) -> bool {
        !self.is_within || self.decoder.is_finished() && self.decoder.can_collect() == 0
    }
}

/// Whether a frame that has been read holds what was packed, as far as it says.
fn checksum_fits(decoder: &FrameDecoder) -> bool {
    match (decoder.get_checksum_from_data(), decoder.get_calculated_checksum()) {
        (Some(expected), Some(found)) => expected == found,
        _ => true,
    }
}
