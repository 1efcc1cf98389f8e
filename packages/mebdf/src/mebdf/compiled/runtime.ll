; Functions that kernels take from numba's runtime: the square root is an instruction, no array owns memory,
; and a new shape is new strides, for all arrays are contiguous.
declare double @llvm.sqrt.f64(double)
define linkonce_odr double @sqrt(double %x) {
  %root = call double @llvm.sqrt.f64(double %x)
  ret double %root
}
define linkonce_odr void @NRT_incref(ptr %0) {
  ret void
}
define linkonce_odr void @NRT_decref(ptr %0) {
  ret void
}
define linkonce_odr i32 @numba_attempt_nocopy_reshape(i64, ptr, ptr, i64 %n, ptr %shape, ptr %out, i64 %size, i32) {
begin:
  br label %test
test:
  %i = phi i64 [ %n, %begin ], [ %next, %loop ]
  %stride = phi i64 [ %size, %begin ], [ %more, %loop ]
  %over = icmp eq i64 %i, 0
  br i1 %over, label %end, label %loop
loop:
  %next = sub i64 %i, 1
  %to = getelementptr i64, ptr %out, i64 %next
  store i64 %stride, ptr %to
  %from = getelementptr i64, ptr %shape, i64 %next
  %length = load i64, ptr %from
  %more = mul i64 %stride, %length
  br label %test
end:
  ret i32 1
}
