# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Charts as SVG, written by hand."""
import math

WIDTH, HEIGHT = 760, 420
LEFT, RIGHT, TOP, BOTTOM = 70, 200, 40, 50
COLOURS = {
    "scalar": "#7f7f7f",
    "sse4": "#1f77b4",
    "avx2": "#2ca02c",
    "avx512": "#d62728",
    "neon": "#1f77b4",
    "sve": "#2ca02c",
    "sve2": "#d62728",
}
SERIES = ["#d62728", "#1f77b4", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b", "#e377c2", "#17becf"]


class Chart:
    """Axes, logarithmic or not, and what is drawn into them."""

    def __init__(self, title, x_title, y_title, x, y, x_log=True, y_log=True):
        self.x_range, self.y_range, self.x_log, self.y_log = x, y, x_log, y_log
        self.legend = 0
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
            'font-family="sans-serif" font-size="12">',
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
            f'<text x="{LEFT}" y="22" font-size="15">{title}</text>',
            f'<text x="{(LEFT + WIDTH - RIGHT) / 2:.0f}" y="{HEIGHT - 10}" text-anchor="middle">'
            f"{x_title}</text>",
            f'<text x="16" y="{(TOP + HEIGHT - BOTTOM) / 2:.0f}" text-anchor="middle" '
            f'transform="rotate(-90 16 {(TOP + HEIGHT - BOTTOM) / 2:.0f})">{y_title}</text>',
        ]

    @staticmethod
    def _part(value, low_high, log):
        low, high = low_high
        if log:
            return math.log(value / low) / math.log(high / low)
        return (value - low) / (high - low)

    def x(self, value):
        return LEFT + self._part(value, self.x_range, self.x_log) * (WIDTH - LEFT - RIGHT)

    def y(self, value):
        return HEIGHT - BOTTOM - self._part(value, self.y_range, self.y_log) * (HEIGHT - TOP - BOTTOM)

    def x_ticks(self, ticks):
        for value, text in ticks:
            x = self.x(value)
            self.parts += [
                f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>',
                f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 17}" text-anchor="middle">{text}</text>',
            ]

    def y_ticks(self, ticks):
        for value in ticks:
            y = self.y(value)
            self.parts += [
                f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>',
                f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>',
            ]

    def name(self, text, colour, dashed=False):
        y = TOP + 10 + 18 * self.legend
        self.legend += 1
        self.parts += [
            f'<path d="M{WIDTH - RIGHT + 12} {y}h22" stroke="{colour}" stroke-width="2"{_dash(dashed)}/>',
            f'<text x="{WIDTH - RIGHT + 40}" y="{y + 4}">{text}</text>',
        ]

    def line(self, points, colour, text, dashed=False):
        if not points:
            return
        path = " ".join(f"{self.x(a):.1f},{self.y(b):.1f}" for a, b in points)
        self.parts.append(
            f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{_dash(dashed)}/>'
        )
        if not dashed:
            self.parts += [
                f'<circle cx="{self.x(a):.1f}" cy="{self.y(b):.1f}" r="2.5" fill="{colour}"/>'
                for a, b in points
            ]
        self.name(text, colour, dashed)

    def dot(self, a, b, colour):
        self.parts.append(
            f'<circle cx="{self.x(a):.1f}" cy="{self.y(b):.1f}" r="3.5" fill="{colour}" fill-opacity="0.7"/>'
        )

    def bar(self, left, right, value, colour):
        x, y = self.x(left), self.y(value)
        self.parts += [
            f'<rect x="{x:.1f}" y="{y:.1f}" width="{self.x(right) - x:.1f}" '
            f'height="{HEIGHT - BOTTOM - y:.1f}" fill="{colour}"/>',
            f'<text x="{(x + self.x(right)) / 2:.1f}" y="{y - 3:.1f}" text-anchor="middle" '
            f'font-size="10">{value:.1f}</text>',
        ]

    def text(self):
        return "\n".join(self.parts + ["</svg>"]) + "\n"


def _dash(dashed):
    return ' stroke-dasharray="6 4"' if dashed else ""
