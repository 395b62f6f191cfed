"""Icons and colours of the window."""

from __future__ import annotations

from functools import cache

from PyQt5.QtCore import QByteArray, QRectF, Qt
from PyQt5.QtGui import QColor, QIcon, QPainter, QPalette, QPixmap
from PyQt5.QtSvg import QSvgRenderer

INK, FAINT, ACCENT, RED = "#39424e", "#a9b1bc", "#2468c9", "#cf3b34"

#: What is drawn on a field of 24 x 24 with a pen of 1.7; {i} is the ink, {a} the accent, {r} red.
_DRAWINGS = {
    "reset": '<path d="M18.5 9A7.3 7.3 0 1 0 19.3 13"/><path d="M19 3.8V9h-5.2"/>',
    "step": '<path d="M6 5.5l8.5 6.5L6 18.5z" fill="{i}"/><path d="M18.2 5.5v13"/>',
    "play": '<path d="M7.5 4.8L18.8 12 7.5 19.2z" fill="{a}" stroke="{a}"/>',
    "pause": '<path d="M8.3 5.5v13M15.7 5.5v13" stroke="{a}" stroke-width="3.6"/>',
    "animate": '<rect x="3" y="5.5" width="18" height="13" rx="2"/><path d="M10.2 9.3l4.6 2.7-4.6 2.7z" fill="{i}"/>',
    "screenshot": '<path d="M3.5 8h4l1.8-2.7h5.4L16.5 8h4v11h-17z"/><circle cx="12" cy="13.2" r="3.2"/>',
    "capture": '<circle cx="12" cy="12" r="8"/><circle cx="12" cy="12" r="3.8" fill="{r}" stroke="{r}"/>',
    "empty": '<path d="M4.5 7h15M9.7 7V4.4h4.6V7M6.5 7l.9 12.8h9.2l.9-12.8M10.3 10.7v5.6M13.7 10.7v5.6"/>',
    "movie": '<path d="M4 10.2h16v9H4zM4 10.2L3.3 7l15.8-3.4.7 3.1zM8.3 6l2 2.8M13.2 4.9l2 2.8"/>',
    "open": '<path d="M3.5 6.3h6l2 2.2h9v10h-17z"/>',
    "help": '<circle cx="12" cy="12" r="8.5"/><path d="M9.4 9.6a2.7 2.7 0 1 1 3.6 2.6c-.8.3-1 .8-1 1.6M12 16.6v.3"/>',
    "contacts": (
        '<path d="M3 18.5h18"/><circle cx="12" cy="11" r="5"/><circle cx="12" cy="18" r="1.9" fill="{r}" stroke="{r}"/>'
    ),
    "contact_forces": '<path d="M3 20h18"/><path d="M12 19V5.5M7.6 9.6L12 4.6l4.4 5" stroke="{r}"/>',
    "centers_of_mass": (
        '<circle cx="12" cy="12" r="8"/><path d="M12 4a8 8 0 0 1 8 8h-8zM12 20a8 8 0 0 1-8-8h8z" fill="{i}"/>'
    ),
    "frames": '<path d="M8 16V4M8 16h12M8 16l-4.6 4.6" /><circle cx="8" cy="16" r="1.6" fill="{i}"/>',
    "joint_axes": (
        '<path d="M12 2.8v18.4" stroke-dasharray="3 2.4"/><path d="M5.3 14.2c2.6 3 10.8 3 13.4 0M18.9 10.4v4h-4"/>'
    ),
    "collision_shapes": (
        '<path d="M12 3.2l7.6 4.4v8.8L12 20.8l-7.6-4.4V7.6z" stroke-dasharray="3 2.2"/>'
        '<circle cx="12" cy="12" r="3.6"/>'
    ),
    "sleepers": '<path d="M19.5 14.2A8 8 0 1 1 9.8 4.5a6.4 6.4 0 0 0 9.7 9.7z"/>',
    "wireframe": '<path d="M12 3.2l7.6 4.4v8.8L12 20.8l-7.6-4.4V7.6zM4.4 7.6L12 12l7.6-4.4M12 12v8.8"/>',
    "shadows": '<circle cx="12" cy="9" r="5.2"/><ellipse cx="12" cy="18.6" rx="7.4" ry="1.9" fill="{i}"/>',
    "follow": (
        '<circle cx="12" cy="12" r="6"/><circle cx="12" cy="12" r="1.4" fill="{i}"/>'
        '<path d="M12 2.5V6M12 18v3.5M2.5 12H6M18 12h3.5"/>'
    ),
    "frame_all": (
        '<path d="M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5"/><rect x="8.5" y="8.5" width="7" height="7" rx="1"/>'
    ),
    "next_camera": '<rect x="3" y="7" width="12.5" height="10" rx="2"/><path d="M15.5 11l5.5-3v8l-5.5-3z"/>',
    "plot": '<path d="M4 4v16h16M6.5 15.5c2.4 0 2.6-8 5-8s2.6 5.5 4.2 5.5 2-3 3.8-3"/>',
}


@cache
def icon(name: str, checked: str | None = None) -> QIcon:
    """An icon by the name of its action; `checked` names another drawing for when it is down."""
    result = QIcon()
    for mode, ink in ((QIcon.Normal, INK), (QIcon.Disabled, FAINT)):
        for size in (20, 40, 60):
            result.addPixmap(_pixmap(name, size, ink), mode, QIcon.Off)
            result.addPixmap(_pixmap(checked or name, size, ink), mode, QIcon.On)
    return result


def _pixmap(name: str, size: int, ink: str) -> QPixmap:
    faint = ink == FAINT
    drawing = _DRAWINGS[name].format(i=ink, a=ink if faint else ACCENT, r=ink if faint else RED)
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><g fill="none" '
        f'stroke="{ink}" stroke-width="1.7" stroke-linecap="round" stroke-linejoin="round">{drawing}</g></svg>'
    )
    pixmap = QPixmap(size, size)
    pixmap.fill(Qt.transparent)
    painter = QPainter(pixmap)
    QSvgRenderer(QByteArray(svg.encode())).render(painter, QRectF(0, 0, size, size))
    painter.end()
    return pixmap


def palette() -> QPalette:
    """Light, whatever the desktop's theme."""
    colors = QPalette()
    for role, color in (
        (QPalette.Window, "#f3f5f7"),
        (QPalette.WindowText, INK),
        (QPalette.Base, "#ffffff"),
        (QPalette.AlternateBase, "#f7f9fa"),
        (QPalette.Text, INK),
        (QPalette.Button, "#fafbfc"),
        (QPalette.ButtonText, INK),
        (QPalette.Highlight, ACCENT),
        (QPalette.HighlightedText, "#ffffff"),
        (QPalette.ToolTipBase, "#ffffff"),
        (QPalette.ToolTipText, INK),
    ):
        colors.setColor(role, QColor(color))
    for role in (QPalette.Text, QPalette.WindowText, QPalette.ButtonText):
        colors.setColor(QPalette.Disabled, role, QColor(FAINT))
    return colors


SHEET = f"""
QMainWindow::separator {{ width: 5px; height: 5px; background: #e6e9ed; }}
QToolBar {{ background: #fbfcfd; border: 0; border-bottom: 1px solid #dde1e6; padding: 3px; spacing: 1px; }}
QToolBar:vertical {{ border-bottom: 0; border-right: 1px solid #dde1e6; }}
QToolBar QToolButton {{ border: 0; border-radius: 5px; padding: 4px 7px; color: {INK}; }}
QToolBar:vertical QToolButton {{ padding: 6px; margin: 1px; }}
QToolBar QToolButton:hover {{ background: #e8edf3; }}
QToolBar QToolButton:pressed, QToolBar QToolButton:checked {{ background: #d6e4f7; }}
QMenuBar {{ background: #fbfcfd; border-bottom: 1px solid #e8ebef; }}
QStatusBar {{ background: #fbfcfd; border-top: 1px solid #dde1e6; }}
QStatusBar QLabel {{ padding: 2px 8px; }}
QStatusBar::item {{ border: 0; }}
QDockWidget {{ font-weight: 600; }}
QDockWidget::title {{ background: #eef1f4; padding: 5px 8px; }}
QTreeWidget, QScrollArea {{ border: 1px solid #dde1e6; border-radius: 4px; background: #ffffff; }}
QTreeWidget::item {{ height: 20px; }}
QLabel#heading {{ font-weight: 600; padding: 2px; }}
QLabel#help {{ background: rgba(28, 34, 42, 225); color: #f2f5f8; border-radius: 10px; padding: 18px; }}
QPlainTextEdit#traceback {{ background: #fff8f7; border: 1px solid #efc9c6; border-radius: 4px; color: #7c1f1a; }}
QLabel#error {{ color: {RED}; font-weight: 600; }}
QSlider::groove:horizontal {{ height: 4px; background: #d9dee4; border-radius: 2px; }}
QSlider::sub-page:horizontal {{ background: #9dbfe9; border-radius: 2px; }}
QSlider::handle:horizontal {{ width: 12px; height: 12px; margin: -4px 0; border-radius: 6px; background: {ACCENT}; }}
QSlider::handle:horizontal:disabled, QSlider::sub-page:horizontal:disabled {{ background: #c3c9d1; }}
"""
