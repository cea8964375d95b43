//! MP4 with no other program: H.264 by OpenH264.

use std::fs::File;
use std::io::{self, BufWriter};
use std::sync::Arc;

use muxide::api::{Muxer, MuxerBuilder, VideoCodec};
use openh264::OpenH264API;
use openh264::encoder::{
    BitRate, Complexity, Encoder, EncoderConfig, FrameRate, FrameType, IntraFramePeriod, QpRange,
    RateControlMode, UsageType, VuiConfig,
};
use openh264::formats::YUVSlices;

use super::Encode;
use super::yuv::Yuv;
use crate::output::RepeatedPicture;

/// The coarsest and finest steps of a picture's frequencies.
const STEPS: (u8, u8) = (18, 26);

/// Seconds between pictures that stand alone, where players can begin.
const APART: f64 = 4.0;

pub struct H264 {
    encoder: Encoder,
    muxer: Muxer<BufWriter<File>>,
    yuv: Yuv,
    size: [usize; 2],
    fps: f64,
    frames: u64,
    bytes: Vec<u8>,
}

impl H264 {
    /// For pictures of an even width and height.
    pub fn new(file: File, size: [u32; 2], fps: f64) -> io::Result<H264> {
        let config = EncoderConfig::new()
            .usage_type(UsageType::CameraVideoRealTime)
            .rate_control_mode(RateControlMode::Off)
            .bitrate(BitRate::from_bps(20_000_000))
            .complexity(Complexity::High)
            .qp(QpRange::new(STEPS.0, STEPS.1))
            .skip_frames(false)
            .max_frame_rate(FrameRate::from_hz(fps as f32))
            .intra_frame_period(IntraFramePeriod::from_num_frames((APART * fps).ceil() as u32))
            .num_threads(1)
            .vui(VuiConfig::bt709());
        let encoder =
            Encoder::with_api_config(OpenH264API::from_source(), config).map_err(failed)?;
        let [width, height] = size;
        let muxer = MuxerBuilder::new(BufWriter::new(file))
            .video(VideoCodec::H264, width, height, fps)
            .with_fast_start(true)
            .build()
            .map_err(io::Error::other)?;
        let yuv = Yuv::new(size);
        let size = size.map(|side| side as usize);
        Ok(H264 { encoder, muxer, yuv, size, fps, frames: 0, bytes: Vec::new() })
    }
}

impl Encode for H264 {
    fn add(&mut self, picture: &Arc<RepeatedPicture>, steps: u64) -> io::Result<()> {
        self.yuv.read(picture.picture());
        let [y, cb, cr] = self.yuv.planes();
        let [width, height] = self.size;
        let planes = YUVSlices::new((y, cb, cr), (width, height), (width, width / 2, width / 2));
        for _ in 0..steps {
            let stream = self.encoder.encode(&planes).map_err(failed)?;
            let is_key = matches!(stream.frame_type(), FrameType::IDR | FrameType::I);
            self.bytes.clear();
            stream.write_vec(&mut self.bytes);
            let time = self.frames as f64 / self.fps;
            self.muxer.write_video(time, &self.bytes, is_key).map_err(io::Error::other)?;
            self.frames += 1;
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.muxer.finish_in_place().map_err(io::Error::other)?;
        self.muxer.into_writer().into_inner().map_err(io::IntoInnerError::into_error)?;
        Ok(())
    }
}

fn failed(error: openh264::Error) -> io::Error {
    io::Error::other(format!("OpenH264: {error}"))
}
