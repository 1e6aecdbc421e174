# SPDX-License-Identifier: MIT
"""Cloth in motion as an animation: the up-sampled cloth and the reference side by side."""
import io
import os

import matplotlib
from PIL import Image, ImageDraw, ImageFont

from figures.cloth import moving_shots, panels
from read.vtu import read_vtu

MOVING_PIXELS = 430
MOVING_BYTES = 1500000  # of one animation, and of all of a page twice as much


def moving_panels(shot, kinds, camera, phases, bodies):
    """The panels of one frame of the animation, read and drawn where they are needed."""
    return [
        (
            panels(read_vtu(shot[kind]), kind, camera, MOVING_PIXELS, phases, bodies=bodies)[kind]
            if shot[kind]
            else None
        )
        for kind in kinds
    ]


def moving_kinds(film):
    """What the animation shows side by side."""
    return [kind for kind in ("fine", "reference") if any(shot[kind] for shot in film.shots)] or [
        "coarse"
    ]


def moving_jobs(film, camera, phases, pool, bodies=None):
    """Begins to render the frames of the animation; none with fewer than two of them."""
    shots = moving_shots(film)
    return [
        pool.submit(moving_panels, shot, moving_kinds(film), camera, phases, bodies)
        for shot in shots
        if len(shots) > 1
    ]


def animation(film, camera, jobs, limit):
    """A looping WebP: up-sampled cloth and the reference beside it.

    @param jobs of `moving_jobs`
    @param limit bytes that it may take
    @return (bytes, width in pixels, seconds of one loop, times shown), or None with fewer than two
        frames
    @throws BadFrame
    """
    kinds, shots = moving_kinds(film), moving_shots(film)
    titles = {
        "coarse": "coarse cloth",
        "fine": "up-sampled",
        "reference": f"reference ({film.reference})",
    }
    if not jobs:
        return None
    font = os.path.join(matplotlib.get_data_path(), "fonts", "ttf", "DejaVuSans.ttf")
    font = ImageFont.truetype(font, 15)
    pictures, strip = [], 26
    height = round(MOVING_PIXELS * camera.extent[1] / camera.extent[0])
    for shot, job in zip(shots, jobs):
        picture = Image.new("RGB", (MOVING_PIXELS * len(kinds), height + strip), "white")
        draw = ImageDraw.Draw(picture)
        for i, (kind, image) in enumerate(zip(kinds, job.result())):
            if image is not None:
                image = Image.fromarray(image)
                picture.paste(image, (i * MOVING_PIXELS, strip), image)
            draw.text((i * MOVING_PIXELS + 8, 5), titles[kind], fill="black", font=font)
        label = f"t = {shot['time']:.3f} s"
        draw.text(
            (picture.width - 8 - draw.textlength(label, font=font), 5),
            label,
            fill="black",
            font=font,
        )
        pictures.append(picture)
    duration = min(6.0, max(2.0, shots[-1]["time"] - shots[0]["time"]))
    data = b""
    for quality, every in ((82, 1), (65, 1), (45, 1), (45, 2), (25, 2), (25, 4)):
        some = pictures[::every]
        pause = round(1000.0 * duration / len(some))
        buffer = io.BytesIO()
        some[0].save(
            buffer,
            format="webp",
            save_all=True,
            append_images=some[1:],
            loop=0,
            quality=quality,
            method=4,
            # A rest before it starts again.
            duration=[pause] * (len(some) - 1) + [pause + 700],
        )
        data = buffer.getvalue()
        if len(data) <= limit:
            break
    return data, pictures[0].width, duration, (shots[0]["time"], shots[-1]["time"])
