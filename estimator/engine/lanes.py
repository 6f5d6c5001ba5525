"""Vector instructions on eight numbers at once, for the inner loops of the engine.

Numba unrolls loops of eight before they could become vector instructions, and the engine's blocks
are of eight points. So these few are written as LLVM vectors, which run on every processor. None
checks bounds: arrays must be padded to a multiple of eight (64 where the name says so) from `at`.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numpy.typing import NDArray

from estimator.engine.compiled import compiled


def _instruction(define: Callable[..., Any]) -> Any:  # noqa: ANN401 (called with other arguments)
    return intrinsic(define)


_DOUBLE, _BYTE, _INT32, _INT64 = ir.DoubleType(), ir.IntType(8), ir.IntType(32), ir.IntType(64)
_DOUBLES, _INTS = ir.VectorType(_DOUBLE, 8), ir.VectorType(_INT32, 8)

_SET_LANES = np.array(
    [
        [*(lane for lane in range(8) if mask >> lane & 1), *[0] * (8 - mask.bit_count())]
        for mask in range(256)
    ],
    dtype=np.int32,
).ravel()
"""For each mask the numbers of its set lanes, in order."""


class _Code:
    """LLVM code of one vector function: loads, constants and arithmetic on eight doubles."""

    def __init__(self, context: Any, builder: Any, signature: Any, values: Any) -> None:  # noqa: ANN401
        self.context, self.builder = context, builder
        self.types, self.values = signature.args, values

    def pointer(self, argument: int, at: Any, row: int = 0) -> Any:  # noqa: ANN401
        array_type = self.types[argument]
        array = self.context.make_array(array_type)(
            self.context, self.builder, self.values[argument]
        )
        if row:
            length = self.builder.extract_value(array.shape, array_type.ndim - 1)
            at = self.builder.add(at, self.builder.mul(length, _INT64(row)))
        return self.builder.gep(array.data, [at])

    def load(self, argument: int, at: Any, row: int = 0) -> Any:  # noqa: ANN401
        pointer = self.builder.bitcast(self.pointer(argument, at, row), _DOUBLES.as_pointer())
        return self.builder.load(pointer, align=8)

    def spread(self, value: Any) -> Any:  # noqa: ANN401
        kind = ir.VectorType(value.type, 8)
        first = self.builder.insert_element(ir.Constant(kind, ir.Undefined), value, _INT32(0))
        zeros = ir.Constant(_INTS, [0] * 8)
        return self.builder.shuffle_vector(first, ir.Constant(kind, ir.Undefined), zeros)

    def larger(self, a: Any, b: Any) -> Any:  # noqa: ANN401
        return self.builder.select(self.builder.fcmp_ordered(">", a, b), a, b)

    def smaller(self, a: Any, b: Any) -> Any:  # noqa: ANN401
        return self.builder.select(self.builder.fcmp_ordered("<", a, b), a, b)

    def mask(self, truths: Any) -> Any:  # noqa: ANN401
        return self.builder.zext(self.builder.bitcast(truths, _BYTE), _INT64)

    def sum_of_squares(self, x: Any, y: Any, z: Any) -> Any:  # noqa: ANN401
        squares = [self.builder.fmul(axis, axis) for axis in (x, y, z)]
        # In scikit-learn's order, so that the sums agree to the last bit.
        return self.builder.fadd(self.builder.fadd(squares[0], squares[1]), squares[2])

    def folded(self, vector: Any, join: Callable[[Any, Any], Any]) -> Any:  # noqa: ANN401
        for width in (4, 2, 1):
            lanes = ir.Constant(_INTS, [(lane + width) % 8 for lane in range(8)])
            vector = join(vector, self.builder.shuffle_vector(vector, vector, lanes))
        return self.builder.extract_element(vector, _INT32(0))


def _squared_distances(code: _Code, points: int, at: Any, query: tuple[int, int, int]) -> Any:  # noqa: ANN401
    """Squared distances of eight points of the (3, N) argument `points` from a query."""
    gaps = [
        code.builder.fsub(code.load(points, at, axis), code.spread(code.values[query[axis]]))
        for axis in range(3)
    ]
    return code.sum_of_squares(*gaps)


@_instruction
def near(typing_context, points, at, x, y, z, limit):  # noqa: ANN001, ANN201
    """Mask of the eight points (3, N) from `at` whose squared distance is at most `limit`."""

    def generate(context, builder, signature, values):  # noqa: ANN001, ANN202
        code = _Code(context, builder, signature, values)
        squared = _squared_distances(code, 0, values[1], (2, 3, 4))
        return code.mask(builder.fcmp_ordered("<=", squared, code.spread(values[5])))

    return types.int64(points, types.int64, *[types.float64] * 4), generate


@_instruction
def beyond(typing_context, points, cores, at, x, y, z, core, limit):  # noqa: ANN001, ANN201
    """Mask as of `near`, less those within the squared `core` or within their own of `cores`."""

    def generate(context, builder, signature, values):  # noqa: ANN001, ANN202
        code = _Code(context, builder, signature, values)
        squared = _squared_distances(code, 0, values[2], (3, 4, 5))
        core = code.larger(code.load(1, values[2]), code.spread(values[6]))
        within = builder.fcmp_ordered("<=", squared, code.spread(values[7]))
        return code.mask(builder.and_(within, builder.fcmp_ordered(">", squared, core)))

    return types.int64(points, cores, types.int64, *[types.float64] * 5), generate


@_instruction
def boxes_near(typing_context, boxes, at, x0, y0, z0, x1, y1, z1, limit):  # noqa: ANN001, ANN201
    """Mask of the eight boxes (6, B) from `at` that are within `limit`, squared, of a box."""

    def generate(context, builder, signature, values):  # noqa: ANN001, ANN202
        code = _Code(context, builder, signature, values)
        zero, gaps = ir.Constant(_DOUBLES, [0.0] * 8), []
        for axis in range(3):
            below = builder.fsub(code.load(0, values[1], axis), code.spread(values[5 + axis]))
            above = builder.fsub(code.spread(values[2 + axis]), code.load(0, values[1], 3 + axis))
            gaps.append(code.larger(code.larger(below, above), zero))
        squared = code.sum_of_squares(*gaps)
        return code.mask(builder.fcmp_ordered("<=", squared, code.spread(values[8])))

    return types.int64(boxes, types.int64, *[types.float64] * 7), generate


@_instruction
def _put(typing_context, out, size, first, mask, set_lanes):  # noqa: ANN001, ANN202
    def generate(context, builder, signature, values):  # noqa: ANN001, ANN202
        code = _Code(context, builder, signature, values)
        row = code.pointer(4, builder.mul(values[3], _INT64(8)))
        lanes = builder.load(builder.bitcast(row, _INTS.as_pointer()), align=4)
        numbers = builder.add(lanes, code.spread(builder.trunc(values[2], _INT32)))
        place = builder.bitcast(code.pointer(0, values[1]), _INTS.as_pointer())
        builder.store(numbers, place, align=4)
        return builder.add(values[1], builder.ctpop(values[3]))

    return types.int64(out, types.int64, types.int64, types.int64, set_lanes), generate


@_instruction
def minimum_of_64(typing_context, values, at):  # noqa: ANN001, ANN201
    """Smallest of 64 doubles."""

    def generate(context, builder, signature, arguments):  # noqa: ANN001, ANN202
        code = _Code(context, builder, signature, arguments)
        smallest = code.load(0, arguments[1])
        for step in range(1, 8):
            at = builder.add(arguments[1], _INT64(8 * step))
            smallest = code.smaller(smallest, code.load(0, at))
        return code.folded(smallest, code.smaller)

    return types.float64(values, types.int64), generate


@_instruction
def first_equal_of_64(typing_context, values, at, wanted):  # noqa: ANN001, ANN201
    """Number of the first of 64 doubles that equals `wanted`, 64 where there is none."""

    def generate(context, builder, signature, arguments):  # noqa: ANN001, ANN202
        code = _Code(context, builder, signature, arguments)
        wanted, found = code.spread(arguments[2]), _INT64(0)
        for step in range(8):
            at = builder.add(arguments[1], _INT64(8 * step))
            mask = code.mask(builder.fcmp_ordered("==", code.load(0, at), wanted))
            found = builder.or_(found, builder.shl(mask, _INT64(8 * step)))
        return builder.cttz(found, ir.IntType(1)(0))

    return types.int64(values, types.int64, types.float64), generate


@_instruction
def largest_below(typing_context, values, at, bound):  # noqa: ANN001, ANN201
    """Largest of 32 doubles that are below `bound`, -1 where there is none; they are above -1."""

    def generate(context, builder, signature, arguments):  # noqa: ANN001, ANN202
        code = _Code(context, builder, signature, arguments)
        bound, largest = code.spread(arguments[2]), ir.Constant(_DOUBLES, [-1.0] * 8)
        for step in range(4):
            value = code.load(0, builder.add(arguments[1], _INT64(8 * step)))
            below = builder.and_(
                builder.fcmp_ordered("<", value, bound), builder.fcmp_ordered(">", value, largest)
            )
            largest = builder.select(below, value, largest)
        return code.folded(largest, code.larger)

    return types.float64(values, types.int64, types.float64), generate


@_instruction
def count_from(typing_context, values, at, bound):  # noqa: ANN001, ANN201
    """Number of 32 doubles that are at least `bound`."""

    def generate(context, builder, signature, arguments):  # noqa: ANN001, ANN202
        code = _Code(context, builder, signature, arguments)
        bound, found = code.spread(arguments[2]), _INT64(0)
        for step in range(4):
            value = code.load(0, builder.add(arguments[1], _INT64(8 * step)))
            mask = code.mask(builder.fcmp_ordered(">=", value, bound))
            found = builder.or_(found, builder.shl(mask, _INT64(8 * step)))
        return builder.ctpop(found)

    return types.int64(values, types.int64, types.float64), generate


@_instruction
def lowest_set(typing_context, mask):  # noqa: ANN001, ANN201
    """Number of the lowest set bit of a mask that is not zero."""

    def generate(context, builder, signature, values):  # noqa: ANN001, ANN202
        del context, signature
        return builder.cttz(values[0], ir.IntType(1)(0))

    return types.int64(types.int64), generate


@compiled
def put(out: NDArray[np.int32], size: int, first: int, mask: int) -> int:
    """Append `first` + the number of each set bit of a mask, and return the new size.

    Eight places from `size` are written whatever the mask.
    """
    return _put(out, size, first, mask, _SET_LANES)
