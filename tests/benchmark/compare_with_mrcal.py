#!/usr/bin/python3
"""Calibrates the same corners with foresightctl and with mrcal (Debian: mrcal, python3-mrcal).

  compare_with_mrcal.py FOLDER --board checkerboard:7x6:50 --focal 400 [--ctl build/release/bin/foresightctl]

Prints one line a model: mean error, rms, and mean error in images that were not used (every second image, both ways).
"""
import argparse
import glob
import json
import os
import subprocess
import sys
import tempfile

import mrcal
import numpy as np


def errors(x, board):
    """Distances of the corners that were used."""
    e = x[: 2 * board.shape[0] * board.shape[1] * board.shape[2]].reshape(-1, 2)
    weight = board[..., 2].ravel()
    return np.linalg.norm(e[weight > 0], axis=1)


def solve(inputs):
    mrcal.optimize(**inputs)
    return errors(mrcal.optimizer_callback(**inputs)[1], inputs['observations_board'])


def half(inputs, parity):
    """A copy with every second image."""
    part = {k: v.copy() if isinstance(v, np.ndarray) else v for k, v in inputs.items()}
    keep = np.arange(part['frames_rt_toref'].shape[0]) % 2 == parity
    part['frames_rt_toref'] = part['frames_rt_toref'][keep].copy()
    part['observations_board'] = part['observations_board'][keep].copy()
    indices = part['indices_frame_camintrinsics_camextrinsics'][keep].copy()
    indices[:, 0] = np.arange(indices.shape[0])
    part['indices_frame_camintrinsics_camextrinsics'] = indices.astype(np.int32)
    if part.get('imagepaths') is not None:
        part['imagepaths'] = np.array(part['imagepaths'])[keep]
    return part


def cross_validation(inputs):
    total, count = 0.0, 0
    for parity in (0, 1):
        used = half(inputs, parity)
        solve(used)
        others = half(inputs, 1 - parity)
        others['intrinsics'] = used['intrinsics'].copy()
        if others.get('calobject_warp') is not None:
            others['calobject_warp'] = used['calobject_warp'].copy()
        for what in ('intrinsics_core', 'intrinsics_distortions', 'calobject_warp'):
            others['do_optimize_' + what] = False
        others['do_apply_outlier_rejection'] = False
        e = solve(others)
        total += e.sum()
        count += e.size
    return total / count


def with_mrcal(folder, corners, board, model, focal, warp):
    columns, rows = (int(n) for n in board.split(':')[1].split('x'))
    square_m = float(board.split(':')[2]) / 1000.0
    names = sorted({line.split()[0] for line in open(corners) if not line.startswith('#')})
    pattern = os.path.join(folder, '*' + os.path.splitext(names[0])[1])
    with tempfile.TemporaryDirectory() as out:
        command = ['mrcal-calibrate-cameras', '--corners-cache', corners, '--lensmodel', model, '--focal', str(focal),
                   '--object-spacing', str(square_m), '--object-width-n', str(columns), '--object-height-n', str(rows),
                   '--skip-outlier-rejection', '--outdir', out]
        if not warp:
            command.append('--skip-calobject-warp-solve')
        done = subprocess.run(command + [pattern], capture_output=True, text=True)
        if done.returncode != 0:
            return None, done.stderr.strip().splitlines()[-1:]
        inputs = mrcal.cameramodel(glob.glob(os.path.join(out, '*.cameramodel'))[0]).optimization_inputs()
    e = errors(mrcal.optimizer_callback(**inputs)[1], inputs['observations_board'])
    return (e.mean(), np.sqrt((e**2).mean()), cross_validation(inputs), e.size), None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('folder')
    parser.add_argument('--board', required=True)
    parser.add_argument('--focal', type=float, required=True, help="mrcal's start, px")
    parser.add_argument('--ctl', default='build/release/bin/foresightctl')
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        corners = os.path.join(scratch, 'corners.vnl')
        for warp in ('off', 'on'):
            done = subprocess.run([arguments.ctl, 'calibrate', 'intrinsics', arguments.folder, '--board', arguments.board,
                                   '--model', 'k,eucm,kb4,radtan', '--warp', warp, '--json', '--corners', corners],
                                  capture_output=True, text=True)
            if done.returncode > 1:
                sys.exit(done.stderr)
            for m in json.loads(done.stdout):
                if m['mean_error_px'] is None:
                    print(f"foresight {m['model']:<22} warp {warp:<3}  {m['failure']}")
                    continue
                print(f"foresight {m['model']:<22} warp {warp:<3}  mean {m['mean_error_px']:.3f}  rms {m['rms_px']:.3f}  "
                      f"cross-validation {m['cross_validation_px']:.3f}  {m['corners_used']} corners")
        for model in ('LENSMODEL_OPENCV4', 'LENSMODEL_OPENCV8',
                      'LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=16_Ny=12_fov_x_deg=150'):
            for warp in (False, True):
                result, fault = with_mrcal(arguments.folder, corners, arguments.board, model, arguments.focal, warp)
                short = model.replace('LENSMODEL_', '')[:22]
                if result is None:
                    print(f"mrcal     {short:<22} warp {'on ' if warp else 'off'}  {fault}")
                    continue
                mean, rms, predicted, count = result
                print(f"mrcal     {short:<22} warp {'on ' if warp else 'off'}  mean {mean:.3f}  rms {rms:.3f}  "
                      f"cross-validation {predicted:.3f}  {count} corners")


if __name__ == '__main__':
    main()
