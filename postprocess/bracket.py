"""A root of a function of one variable between two points."""


class Bracket:
    """Where to evaluate next, by the Illinois method (Dowell & Jarratt 1971,
    10.1007/BF01934364), by bisection where that does not halve the bracket in
    three evaluations. A point may fail, which is no value: it is passed by.

    As long as the signs of the two ends agree there is no bracket; then one end
    has failed, and the other one is moved towards it."""

    SMALLEST = 1e-9  # width of the bracket over its first width
    SMALLEST_GAP = 1e-3  # between a value and a failure, over the same width

    def __init__(self, ends):
        self.first_ends = tuple(ends)
        self.first_width = abs(ends[1] - ends[0])
        self.points = {}    # x: f, None where it failed
        self.ends = None    # (x, x) of two values of different sign
        self.widths = []    # of the bracket, after each evaluation
        self.weights = {}   # x: factor of its f in the next secant
        self.is_monotone = True

    def add(self, x, f):
        """Takes in f(x); None: the evaluation failed."""
        self.points[x] = f
        if self.ends is None:
            self.find_ends()
        elif f is not None:
            self.move_end(x, f)

    def failed(self):
        return sorted(x for x, f in self.points.items() if f is None)

    def values(self):
        return sorted((x, f) for x, f in self.points.items() if f is not None)

    def best(self):
        """(x, f) with the smallest |f|, or None."""
        return min(self.values(), key=lambda pair: abs(pair[1]), default=None)

    def find_ends(self):
        values = self.values()
        for (x, f), (y, g) in zip(values, values[1:]):
            if f * g <= 0:
                self.ends = (x, y)
                self.weights = {x: 1., y: 1.}
                self.widths.append(y - x)
                return

    def move_end(self, x, f):
        low, high = self.ends
        inside = sorted((self.points[low], self.points[high]))
        if not inside[0] <= f <= inside[1]:
            self.is_monotone = False
        kept = low if f * self.points[low] <= 0 else high
        # Illinois: an end that stays twice counts half.
        repeated = self.weights.get("kept") == kept
        self.weights = {x: 1., kept: self.weights[kept] * (0.5 if repeated else 1.),
                        "kept": kept}
        self.ends = (min(kept, x), max(kept, x))
        self.widths.append(self.ends[1] - self.ends[0])

    def next(self):
        """The next point, or None where there is nothing left to try."""
        for x in self.first_ends:
            if x not in self.points:
                return x
        low, high = self.ends or self.gap_to_failure() or (0, 0)
        smallest = self.SMALLEST if self.ends else self.SMALLEST_GAP
        if high - low <= smallest * self.first_width:
            return None
        stops = [low] + [x for x in self.failed() if low < x < high] + [high]
        if len(stops) > 2 or self.ends is None:
            # Into the widest part that no failure divides.
            width, start = max((b - a, a) for a, b in zip(stops, stops[1:]))
            return start + 0.5 * width
        if len(self.widths) > 3 and self.widths[-1] > 0.5 * self.widths[-4]:
            self.widths = []
            return 0.5 * (low + high)
        f, g = (self.points[x] * self.weights[x] for x in (low, high))
        x = high - g * (high - low) / (g - f) if g != f else low
        margin = 1e-3 * (high - low)
        return min(max(x, low + margin), high - margin)

    def gap_to_failure(self):
        """The part between the outermost value and the failure beyond it, or
        None where both ends failed or both have values."""
        low, high = (self.points[x] for x in sorted(self.first_ends))
        if (low is None) == (high is None):
            return None
        values, failed = [x for x, _ in self.values()], self.failed()
        if high is None:
            return values[-1], min(x for x in failed if x > values[-1])
        return max(x for x in failed if x < values[0]), values[0]
