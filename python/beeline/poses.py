"""Poses of other libraries: scipy, spatialmath, pinocchio. Each is imported where it is used.

Functions of beeline take poses as arrays (4, 4), many as (N, 4, 4), and also objects and lists of objects of these
libraries as they are. They return arrays; the functions `to_...` below convert those.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import Error, _matrix_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["from_any", "to_pinocchio", "to_rigid_transform", "to_rotation", "to_spatialmath"]


def from_any(value: Any, position: ArrayLike | None = None) -> Array:
    """Returns poses as an array.

    Parameters
    ----------
    value : object
        An array (4, 4) or (N, 4, 4), a scipy RigidTransform, a spatialmath SE3, a pin.SE3, or a list of such; or
        a scipy Rotation or a spatialmath SO3, whose position is zero or given.
    position : array_like, default None
        Positions (3,) or (N, 3), m, in place of the positions of `value`.

    Returns
    -------
    array
        (4, 4), or (N, 4, 4) for many.

    Raises
    ------
    beeline.Error
        For matrices of another shape.
    """
    matrices = _matrices(value)
    if matrices.shape[-2:] == (3, 3):
        rotations, matrices = matrices, np.zeros((*matrices.shape[:-2], 4, 4))
        matrices[..., :3, :3], matrices[..., 3, 3] = rotations, 1
    if matrices.ndim not in (2, 3) or matrices.shape[-2:] != (4, 4):
        raise Error(f"poses have the shape {matrices.shape}; expected (4, 4) or (N, 4, 4)")
    if position is not None:
        matrices = matrices.copy()
        matrices[..., :3, 3] = np.asarray(position, dtype=float)
    return matrices


def to_rotation(poses: Any) -> Any:
    """Returns the orientations as a scipy.spatial.transform.Rotation."""
    return _module("scipy.spatial.transform", "scipy").Rotation.from_matrix(from_any(poses)[..., :3, :3])


def to_rigid_transform(poses: Any) -> Any:
    """Returns the poses as a scipy.spatial.transform.RigidTransform, which scipy has since 1.16."""
    return _module("scipy.spatial.transform", "scipy").RigidTransform.from_matrix(from_any(poses))


def to_spatialmath(poses: Any) -> Any:
    """Returns the poses as a spatialmath.SE3, which holds one or many."""
    matrices = from_any(poses)
    se3 = _module("spatialmath", "spatialmath-python").SE3
    return se3(matrices, check=False) if matrices.ndim == 2 else se3(list(matrices), check=False)


def to_pinocchio(poses: Any) -> Any:
    """Returns the pose as a pin.SE3, or many as a list of them."""
    matrices = from_any(poses)
    se3 = _module("pinocchio", "pin").SE3
    return se3(matrices) if matrices.ndim == 2 else [se3(matrix) for matrix in matrices]


def _matrices(value: Any) -> Array:
    """The matrices of an object, 3 x 3 of an orientation."""
    matrix = _matrix_of(value)
    if matrix is value and _holds_objects(value):
        return np.array([_matrices(item) for item in value])
    return np.array(matrix, dtype=float)


def _holds_objects(value: Any) -> bool:
    """Whether a list, or a vector of pinocchio, has items that are poses of other libraries."""
    if isinstance(value, np.ndarray):
        return False
    try:
        first = next(iter(value))
    except (TypeError, StopIteration):
        return False
    return _matrix_of(first) is not first


def _module(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(f"this needs {package}: pip install {package}", name=error.name) from None
