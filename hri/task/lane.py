"""A lane runs one job at a time: a new job replaces the running one."""

from __future__ import annotations

from typing import Any

from hri.task.context import TaskContext
from hri.task.task_run import Job, Task


class Lane:
    """Jobs of one kind, such as answers, of which only the newest counts.

    A lane replaces whole jobs of one owner. Which task may use the drive or the voice, whoever
    started it, is the business of `hri.task.claims`.
    """

    def __init__(self, context: TaskContext) -> None:
        self._manager = context.manager
        self._task: Task | None = None
        self._job: tuple[Job, tuple[Any, ...]] | None = None
        """What was started last."""
        self._is_held = False

    @property
    def is_busy(self) -> bool:
        return self._task is not None and not self._task.is_over

    def runs(self, job: Job) -> bool:
        """Whether this job is the one that runs, not another that took its place."""
        return self.is_busy and self._job is not None and self._job[0] is job

    def start(self, job: Job, *arguments: Any) -> None:
        """Start a job; the one that runs is cancelled."""
        self.stop()
        self._job = (job, arguments)
        self._task = self._manager.install(job, *arguments)

    def hold(self) -> None:
        """Cancel the job that runs, if any, until `resume` starts it again."""
        is_held = self.is_busy
        self.stop()
        self._is_held = is_held

    def resume(self) -> None:
        """Start the job again that was held, unless another was started or it was stopped."""
        if self._is_held and self._job is not None:
            job, arguments = self._job
            self.start(job, *arguments)

    def stop(self) -> None:
        """Cancel the job that runs, if any."""
        self._is_held = False
        if self._task is not None:
            self._task.cancel()
            self._task = None
